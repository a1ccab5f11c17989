// What to show: data, transfer function, views, lights and the effects that the scene calls for. An effect that is
// absent here is not simulated. All colours are linear RGB; all angles in files are degrees, in these structs radians.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/effects.h"
#include "scenes/volume.h"

namespace volumark {

struct Shell;      // scenes/shell.h
struct ScenePlan;  // scenes/scene_plan.h: what load_data has yet to do

// Post-classified continuous emission-absorption: extinction tau(s) [1 / world unit] and colour c(s) are piecewise
// linear in the data value s, constant beyond the first and last point; the emission is tau c. Opacity of a segment of
// length d is 1 - exp(-tau d). Two points at one value make a jump (the value there is the second point's).
struct TransferPoint {
  double value = 0;  // data units, non-decreasing
  glm::dvec3 colour{0};
  double extinction = 0;  // >= 0, finite
};
struct TransferFunction {
  std::vector<TransferPoint> points;  // at least one
  double lo = 0, hi = 1;  // lo < hi: the window, data units: what a table covers; s_n = (s - lo) / (hi - lo)
  // (r, g, b, tau) at data value s.
  glm::dvec4 at(double s) const;
  double max_extinction() const;
};

struct Light {
  enum class Kind { Directional, Point } kind = Kind::Directional;
  glm::dvec3 vector{0, 0, 1};  // Directional: unit direction towards the light; Point: position in world space
  glm::dvec3 colour{1};
};

// Blinn-Phong per sample, with g the central-difference gradient stored at samples (index differences clamped at the
// border, divided by 2 spacing), interpolated trilinearly, normalised after interpolation: n = -g / max(|g|, floor).
// Below the floor the normal shortens with the gradient: the direction of a gradient that vanishes is rounding noise,
// and would show as such; in homogeneous matter only the ambient term is left. l: to the light, v: to the eye, h = (l +
// v) / |l + v|. Lit colour = c (ambient + sum_i L_i diffuse max(0, n.l)) + sum_i L_i specular max(0, n.h)^shininess
// [n.l > 0]; two_sided: |n.l| and |n.h| instead of max(0, .), and the specular term always.
struct Lighting {
  double ambient = 0.2, diffuse = 0.8, specular = 0, shininess = 32;
  bool two_sided = false;
  double gradient_floor = 1. / 64;  // > 0; in widths of the transfer window a smallest voxel spacing
  std::vector<Light> lights;        // at least one
};

// The floor of |g| in data units a world unit.
double gradient_floor(const Lighting& lighting, const TransferFunction& transfer, const Volume& volume);

struct ClipPlane {
  glm::dvec3 normal{0, 0, 1};  // unit
  double distance = 0;         // keeps normal . p >= distance
};

// What a scene calls for beyond emission and absorption. The vocabulary, and what each name means: scenes/effects.h.
struct Effects {
  std::optional<Lighting> lighting;
  std::vector<ClipPlane> clip_planes;  // empty: not simulated
  bool fixed_point = false;            // arithmetic of the boards of 2000, as docs/effects.md defines it
  std::vector<std::string> others;     // names of the vocabulary that no technique here simulates yet, in its order
};

// What of the data a scene shows: exactly one of these. A method says which it draws (MethodInfo::displays).
enum class Display : uint8_t {
  Direct,      // emission and absorption of the volume
  Isosurface,  // Scene::isosurface
  SlicePlane,  // Scene::slice_plane
  Shell,       // Scene::shell
};
const char* to_string(Display display);  // "direct", "isosurface", "slice_plane", "shell"

// The part of the volume where the interpolated field is at least `value`, taken as solid: a ray shows the first point,
// from the near plane on, at which the field reaches it - on the surface, or where the ray enters the solid through a
// face of the box, a clip plane or the near plane - and is opaque there. Its colour: ambient_colour * ambient + colour
// * sum_i L_i diffuse max(0, n.l) + specular term, all as in Lighting; `colour` alone where no lighting is called for.
// Rays that meet no such point show nothing. The transfer function gives only the window.
struct Isosurface {
  double value = 0;              // data units; may lie outside the data: then all or nothing is solid
  glm::dvec3 colour{1};          // diffuse reflectance
  glm::dvec3 ambient_colour{1};  // reflectance of ambient light; the file's default is `colour`
};

// Multi-planar reformatting: where the plane cuts the volume, the transfer function's colour at the interpolated value,
// opaque; elsewhere nothing. It is not lit. Clip planes cut it.
struct SlicePlane {
  glm::dvec3 point{0};         // world space
  glm::dvec3 normal{0, 0, 1};  // unit
};

struct View {
  glm::dvec3 eye{0, 0, 1}, target{0}, up{0, 1, 0};
  bool perspective = true;
  double fov_y = 0.6;      // radians, perspective
  double half_height = 1;  // world units, orthographic
  double near = 0;         // world units from the eye along the view direction; samples nearer are cut away. > 0 in
                           // perspective; orthographic: may be any value, the eye is on the plane of distance 0
  std::string name;
};

// Orthonormal frame of a view: right, up, and forward (towards the target).
struct ViewFrame {
  glm::dvec3 right, up, forward;
};
ViewFrame frame_of(const View& view);

// The ray through the centre of pixel (x, y) (row 0 on top): points origin + t direction, |direction| = 1, for t >=
// t_near (where the near plane cuts it).
struct Ray {
  glm::dvec3 origin, direction;
  double t_near;
};
Ray pixel_ray(const View& view, int width, int height, double x, double y);

// World -> clip space with depth 0..1, NDC +y up; `far` > near in the same units as View::near.
glm::dmat4 world_to_clip(const View& view, int width, int height, double far);

struct DataSource {
  std::string origin;  // "procedural", "file", "debian:PACKAGE"
  std::string path;    // of the file read; empty for procedural data
  std::string sha256;  // of that file
  std::string licence;
  std::string how_to_get;
};

struct Scene {
  std::string name, title, description;
  std::string path;  // of the scene file
  std::string hash;  // sha256 over everything that decides its picture: the parsed scene, and the data's sha256
  std::shared_ptr<const Volume> volume;  // null until load_data, and in scenes that show a shell
  DataSource source;
  TransferFunction transfer;
  std::vector<View> views;
  int width = 512, height = 512;
  glm::dvec3 background{0};
  Effects effects;
  // At most one of these; none: the volume is shown directly.
  std::optional<Isosurface> isosurface;
  std::optional<SlicePlane> slice_plane;
  std::shared_ptr<const Shell> shell;     // null until load_data
  Display display = Display::Direct;      // what the file asks for; set by the parser, or by whoever sets one of these
  std::shared_ptr<const ScenePlan> plan;  // of a parsed scene; null in one that was put together by hand
};

}  // namespace volumark
