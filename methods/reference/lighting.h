// Lighting (scenes/scene.h) along one ray, in the volume's own axes. A chord's gradient is a cubic in each component,
// so g . l is a polynomial; shading jumps or bends where it is zero.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "methods/reference/polynomial.h"
#include "scenes/scene.h"

namespace volumark {

using GradientChord = std::array<Cubic, 3>;  // components as functions of u in [0, 1] along a chord

class RayLights {
 public:
  // `axes`: of the frame of the gradients, in world space. `floor`: gradient_floor() of the scene.
  RayLights(const Lighting& lighting, const glm::dmat3& axes, const Ray& ray, double floor);
  RayLights(const Lighting& lighting, const Volume& volume, const Ray& ray, double floor);

  // Lit colour at distance t along the ray, where the gradient and the unlit colour are these.
  glm::dvec3 shade(const glm::dvec3& gradient, double t, const glm::dvec3& colour) const;
  // The same with a reflectance of its own for ambient light.
  glm::dvec3 shade(const glm::dvec3& gradient, double t, const glm::dvec3& colour,
                   const glm::dvec3& ambient_colour) const;
  // How far a change of the gradient by `error` can change any channel of a lit colour with channels up to 1: to first
  // order in it, and where it decides on which side a light stands, all of that light's highlight.
  double shading_error(const glm::dvec3& gradient, double t, double error) const;

  // Appends the u in (0, 1) of the chord [t0, t0 + length] where some light changes sides, or the gradient's
  // length passes the floor.
  void append_splits(const GradientChord& gradient, double t0, double length, std::vector<double>& splits) const;

 private:
  struct LightOnRay {
    bool point;
    glm::dvec3 vector;  // unit, to the light; or the light's position relative to the ray's origin
    glm::dvec3 half;    // directional lights
    glm::dvec3 colour;
  };
  // What one light adds to the factor of the colour (`diffuse`) and beside it (`specular`).
  struct Contribution {
    double diffuse = 0, specular = 0;
    double n_l = 0, n_h = 0;
  };
  Contribution contribution(const LightOnRay& light, const glm::dvec3& normal, double t) const;
  glm::dvec3 unit_normal(const glm::dvec3& gradient) const;  // shorter below the floor
  void append_highlight_edges(const GradientChord& gradient, const LightOnRay& light, double t0, double length,
                              std::vector<double>& splits) const;

  const Lighting& lighting_;
  double floor_;
  glm::dvec3 direction_;
  int whole_shininess_;  // the exponent where it is a whole number up to 1024, else -1
  std::vector<LightOnRay> lights_;
};

// Lit colours stay below gain * (largest channel of c) + offset.
struct LightingBound {
  double gain = 1, offset = 0;
};
LightingBound lighting_bound(const Lighting& lighting);

}  // namespace volumark
