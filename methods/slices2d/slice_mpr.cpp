#include "methods/slices2d/slice_mpr.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "methods/slices2d/plane_section.h"
#include "methods/slices2d/stack_parameters.h"
#include "methods/slices2d/strip_drawing.h"
#include "programs/slice_mpr_frag.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using stack_parameters::kWeights;

const Flag kInterpolation{"interpolation",
                          "on: between the two stored slices beside a point; off: the nearest stored slice", true,
                          Ideal<bool>{true, "interpolation of slices"}};

const Choice kClassification{
    "classification",
    "post: the transfer function is applied to interpolated samples; pre: to the voxels, whose "
    "colours are interpolated (paletted textures)",
    {"post", "pre"},
    "post",
    Ideal<const char*>{"post", "classification"}};
}  // namespace parameters

ProgramDesc program_of(const Scene& scene, const Values& values) {
  ProgramDesc program;
  program.label = "slice_mpr";
  program.stages = {&programs::slice_mpr_frag};
  program.bindings = SliceStacks::declarations();
  program.constants = VolumeResources::constants(scene, stack_classification_of(values), false);
  program.constants.push_back({"VM_INTERPOLATE", parameters::kInterpolation(values) ? 1 : 0});
  program.constants.push_back({"VM_CORNER_WEIGHTS", parameters::kWeights(values) == "corners" ? 1 : 0});
  program.cpu = &slice_mpr_twin;
  return program;
}

// The scene as the stacks are to hold it: classified voxels are opaque, so that their associated colours are the
// colours (1 - exp(-100) is 1 in every format).
Scene opaque_scene(const Scene& scene) {
  Scene out = scene;
  for (TransferPoint& point : out.transfer.points) point.extinction = 100 / smallest_spacing(*scene.volume);
  return out;
}

class PreparedMpr final : public PreparedMethod {
 public:
  PreparedMpr(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        interpolate_(parameters::kInterpolation(values)),
        stacks_(opaque_scene(scene), stack_settings_of(values), device),
        drawing_(stacks_, program_of(scene, values), Blend::Opaque, Format::RGBA32F, device) {}

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  int cut(const ViewRays& rays, const LocalPlane& plane);

  Scene scene_;  // shares the volume
  bool interpolate_;
  SliceStacks stacks_;
  StripDrawing drawing_;
  StripBuilder strips_;
  std::vector<PlanePoint> polygon_;
  Counters counters_;
};

LocalPlane local_slice_plane(const Scene& scene) {
  const SlicePlane& plane = *scene.slice_plane;
  Scene cut = scene;
  cut.effects.clip_planes = {{plane.normal, glm::dot(plane.normal, plane.point)}};
  return local_clip_planes(cut).front();
}

double stored_at(double local, double extent, int size) { return (local / extent + 0.5) * (size - 1); }

// The stack that the polygon crosses in the fewest strips. Ties: k before j before i, as in best_stack.
int fewest_strips(const std::vector<glm::dvec3>& polygon, const Volume& volume) {
  const glm::dvec3 extent = volume.extent();
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : polygon) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 crossed = (high - low) / extent * glm::dvec3(volume.size - 1);
  int best = 2;
  for (const int axis : {1, 0})
    if (crossed[axis] < crossed[best] - 1e-9) best = axis;
  return best;
}

// Strips of `plane`; returns the stack.
int PreparedMpr::cut(const ViewRays& rays, const LocalPlane& plane) {
  const Volume& volume = *scene_.volume;
  const std::vector<glm::dvec3> section = visible_section(volume.extent(), rays, plane);
  strips_.clear();
  if (section.size() < 3) return 2;
  const int axis = fewest_strips(section, volume);
  polygon_.clear();
  for (const glm::dvec3& p : section) {
    polygon_.push_back({clip_place(rays, p), stored_at(p[axis], volume.extent()[axis], volume.size[axis])});
  }
  const auto between = interpolate_ ? StripBuilder::Between::TwoSlices : StripBuilder::Between::HalfWays;
  strips_.add(polygon_, between, 0, stacks_.layout(axis), 0);
  return axis;
}

void PreparedMpr::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  const LocalPlane plane = local_slice_plane(scene_);
  const int axis = cut(view_rays(*scene_.volume, view, width, height), plane);
  VolumeUniforms uniforms = turned(volume_uniforms(scene_, view, width, height), axis);
  stacks_.fill(uniforms);
  uniforms.own[0] = {2.F / static_cast<float>(width), -2.F / static_cast<float>(height), 0,
                     static_cast<float>(stacks_.layout(axis).slices - 1)};
  // local = (box - .5) extent; of unit length again, whatever the scene's scale.
  const glm::dvec3 in_box = turned(plane.normal * scene_.volume->extent(), axis), normal = glm::normalize(in_box);
  const double distance = plane.distance / glm::length(in_box) + 0.5 * (normal.x + normal.y + normal.z);
  uniforms.own[0][2] = static_cast<float>(distance);
  for (size_t i = 0; i < 3; ++i) uniforms.own[3][i] = static_cast<float>(normal[static_cast<int>(i)]);
  device.end_zone();
  drawing_.draw(strips_, axis, uniforms, target);
  counters_ = drawing_.counters(strips_, axis);
}

class SliceMpr final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "slice_mpr",
        "One slice of any direction, cut into strips between the slices of 2D textures",
        "rezksalama2000",
        {parameters::kInterpolation.info(), parameters::kWeights.info(), parameters::kClassification.info(),
         parameters::kVolumeFormat.info(), parameters::kTableSize.info()},
        {"clip_planes"},
        nullptr,
        {},
        {Display::SlicePlane}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    return stacks_unsupported(scene, stack_settings_of(values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedMpr>(scene, values, device);
  }
  Format target_format(const Values&) const override { return Format::RGBA32F; }
};

}  // namespace

const Method& slice_mpr() {
  static const SliceMpr method;
  return method;
}

}  // namespace volumark
