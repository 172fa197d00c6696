// Principal axes of a symmetric 3 by 3 matrix.
#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>

namespace windfall::sim {

/// Eigenvalues and vectors (columns) of a symmetric matrix by Jacobi's turns.
inline void symmetricEigen(glm::dmat3 a, glm::dvec3& values, glm::dmat3& vectors) {
  vectors = glm::dmat3(1);
  for (int sweep = 0; sweep < 8; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        const double off = a[q][p];
        if (off == 0) continue;
        const double t = (a[q][q] - a[p][p]) / (2 * off);
        const double tangent = (t < 0 ? -1.0 : 1.0) / (std::abs(t) + std::sqrt(t * t + 1));
        const double c = 1 / std::sqrt(tangent * tangent + 1), s = tangent * c;
        glm::dmat3 turn(1);
        turn[p][p] = turn[q][q] = c;
        turn[q][p] = s;
        turn[p][q] = -s;
        a = glm::transpose(turn) * a * turn;
        vectors = vectors * turn;
      }
    }
  }
  values = glm::dvec3(a[0][0], a[1][1], a[2][2]);
}

}  // namespace windfall::sim
