// Pieces of a part that thin out with distance (part_pieces.h). Needs skin.glsl.
layout(location = 2) uniform vec4 pieceSight;  // eye, px a metre at one metre; negative: everywhere
layout(location = 3) uniform vec4 pieceRange;  // first vertex, vertices, m of a piece's width, m from the root to what is farthest

const float kWidest = 0.35, kFadingArea = 0.875, kNear = 0.1;

// How far a piece's vertex moves along its normal, m.
float pieceWidening(uint firstLink) {
  float far = pieceSight.w < 0.0 ? 1.0 : max(distance(bones[firstLink][3].xyz, pieceSight.xyz) - pieceRange.w, kNear);
  float share = pieceRange.z * abs(pieceSight.w) / far / kWidest;
  float rank = (float(gl_VertexID) - pieceRange.x) / pieceRange.y;
  float drawn = share / kFadingArea;
  // The last quarter of those that are drawn is the thinner the later.
  float fading = clamp((drawn - rank) / (0.25 * drawn), 0.0, 1.0);
  return 0.5 * pieceRange.z * (fading * max(1.0, 1.0 / share) - 1.0);
}
