// From where the pictures of cards are taken: right and up of a view along `direction` (out of the picture).
void cardAxes(vec3 direction, out vec3 right, out vec3 up) {
  right = abs(direction.y) > 0.99 ? vec3(1.0, 0.0, 0.0) : normalize(cross(vec3(0.0, 1.0, 0.0), direction));
  up = cross(direction, right);
}
