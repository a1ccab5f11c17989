// The planes of one view, and the float arithmetic of a plane and an edge (lensch2002, section 3), which host, CPU
// twins and GPU programs (shell_planes.glsl) do in the same operations in the same order, so that they agree about
// every sign.
//
// Depths are counted in planes: the plane with number k is where depth = k, number 0 is the nearest, and numbers grow
// away from the eye. A slab of one unit of depth around each plane is what the plane stands for.
#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "methods/shell_slices/prisms.h"
#include "methods/volume/volume_uniforms.h"
#include "scenes/scene.h"

namespace volumark {

// Field by field as in shell_planes.glsl (std140).
struct ShellUniforms {
  Float4 depth{};    // depth = dot(xyz, p) + w
  Float4 across{};   // NDC x = (dot(xyz, p) + w) / lens(k)
  Float4 up{};       // NDC y, likewise
  Float4 lens{};     // x + y k: the divisor on plane k; z: number of planes; w: 1 / the radius of the shell
  Float4 window{};   // NDC = xy * window + (-1, 1); zw: a ray is sqrt(1 + (zw * NDC)^2) long per unit of depth
  Float4 texture{};  // x, y: where w is clamped to; z: world units between planes; w: what texels are multiplied by
  Float4 texel{};    // between neighbouring texels, in texture coordinates
  Float4 slope{};    // what differences of texels on both sides are multiplied by to be a gradient
};
static_assert(sizeof(ShellUniforms) == 128);

// How many planes, and where: `planes` of them evenly spaced over what the prisms fill in depth behind the near plane,
// each in the middle of its slab. No planes where nothing is behind the near plane. Fills all but texture.xyw, texel
// and slope.
struct ShellFrame {
  ShellUniforms uniforms;
  int planes = 0;
  double first = 0, step = 1;  // world units along the view from the shell's middle: plane k is at first + k step
  glm::dvec3 forward{0};
};
ShellFrame shell_frame(const ShellPrisms& shell, const View& view, int width, int height, int planes);

// ---- Arithmetic that is shared with the programs --------------------------------------------------------------------

inline float plane_depth(const ShellUniforms& u, const glm::vec3& p) {
  return ((p.x * u.depth[0] + p.y * u.depth[1]) + p.z * u.depth[2]) + u.depth[3];
}

// The point of an edge that is on a plane, given by the depths of the edge's ends less the plane's number: weights of
// the ends. Exchanging the ends exchanges the weights, to the last bit; the sum of the weights is 1 but for rounding,
// and the point lies between the ends whatever the depths are. Nothing here can be infinite.
struct EdgeWeights {
  float a, b;
};
inline EdgeWeights edge_weights(float depth_a, float depth_b) {
  const float a = std::abs(depth_b), b = std::abs(depth_a);
  const float sum = a + b;
  // Both ends on the plane: only where a program's rounding differs from the host's.
  if (!(sum > 0)) return {.5F, .5F};
  return {a / sum, b / sum};
}
inline glm::vec3 on_edge(const EdgeWeights& weights, const glm::vec3& a, const glm::vec3& b) {
  return {weights.a * a.x + weights.b * b.x, weights.a * a.y + weights.b * b.y, weights.a * a.z + weights.b * b.z};
}

inline glm::mat3 on_edge(const EdgeWeights& weights, const glm::mat3& a, const glm::mat3& b) {
  return {on_edge(weights, a[0], b[0]), on_edge(weights, a[1], b[1]), on_edge(weights, a[2], b[2])};
}
// Where lights are computed: 0 at -radius, 1 at +radius of the shell.
inline glm::vec3 to_box(const ShellUniforms& u, const glm::vec3& p) {
  const float scale = .5F * u.lens[3];
  return {p.x * scale + .5F, p.y * scale + .5F, p.z * scale + .5F};
}

inline glm::vec2 to_ndc(const ShellUniforms& u, const glm::vec3& p, float plane) {
  const float lens = u.lens[0] + plane * u.lens[1];
  const float x = ((p.x * u.across[0] + p.y * u.across[1]) + p.z * u.across[2]) + u.across[3];
  const float y = ((p.x * u.up[0] + p.y * u.up[1]) + p.z * u.up[2]) + u.up[3];
  return {x / lens, y / lens};
}

}  // namespace volumark
