#include "methods/slices2d/slices2d_viewport.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "methods/slices2d/stack_parameters.h"
#include "methods/slices2d/strip_drawing.h"
#include "methods/texture3d_slices/slice_geometry.h"
#include "methods/texture3d_slices/slice_parameters.h"
#include "programs/slices2d_viewport_frag.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using namespace slice_parameters;
using stack_parameters::kClassification;
using stack_parameters::kWeights;
}  // namespace parameters

bool linear_opacity(const Values& values) { return parameters::kOpacityCorrection(values) == "linear"; }

double expected_order(const Values& values) {
  // As of texture3d_slices: formats with few bits and pre-classified volumes tend to other pictures.
  const std::string& format = parameters::kVolumeFormat(values);
  if (stack_classification_of(values) == Classification::Pre || parameters::kTargetFormat(values) != "rgba32f" ||
      (format != "native" && format != "r32f")) {
    return 0;
  }
  return clips_slabs(values) && !linear_opacity(values) ? 2 : 1;
}

ProgramDesc program_of(const Scene& scene, const Values& values) {
  ProgramDesc program;
  program.label = "slices2d_viewport";
  program.stages = {&programs::slices2d_viewport_frag};
  program.bindings = SliceStacks::declarations();
  program.constants = VolumeResources::constants(scene, stack_classification_of(values), linear_opacity(values));
  program.constants.push_back({"VM_CLIP_SLABS", clips_slabs(values) ? 1 : 0});
  program.constants.push_back({"VM_CORNER_WEIGHTS", parameters::kWeights(values) == "corners" ? 1 : 0});
  program.cpu = &slices2d_viewport_twin;
  return program;
}

class PreparedViewport final : public PreparedMethod {
 public:
  PreparedViewport(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        clips_(clips_slabs(values)),
        front_to_back_(parameters::kOrder.index(values) == 1),
        step_(step_in_world(scene, values)),
        stacks_(scene, stack_settings_of(values), device),
        drawing_(stacks_, program_of(scene, values), front_to_back_ ? Blend::Under : Blend::Over,
                 target_format_of(values), device) {}

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  void cut(const ViewRays& rays, const Body& body, const Slabs& slabs, const glm::dvec3& extent,
           const StackLayout& layout, const glm::dvec2& margin);

  Scene scene_;  // shares the volume
  bool clips_, front_to_back_;
  double step_;  // world units
  SliceStacks stacks_;
  StripDrawing drawing_;
  StripBuilder strips_;
  std::vector<PlanePoint> polygon_;
  Counters counters_;
};

// How many stored slices the middle of what is left of a slab may lie off its slice.
double reach_of(const ViewRays& rays, double step, const glm::dvec3& extent, const StackLayout& layout) {
  const double slope =
      std::abs(rays.direction.z) + std::abs(rays.direction_x.z) + std::abs(rays.direction_y.z);  // the steepest ray's
  return 0.5 * step * slope / extent.z * (layout.slices - 1);
}

// All in the stack's frame.
void PreparedViewport::cut(const ViewRays& rays, const Body& body, const Slabs& slabs, const glm::dvec3& extent,
                           const StackLayout& layout, const glm::dvec2& margin) {
  const double half = clips_ ? 0.5 * slabs.step : 0, reach = clips_ ? reach_of(rays, step_, extent, layout) : 0;
  strips_.clear();
  for (int i = 0; i < slabs.count; ++i) {
    const double z = slabs.middle(front_to_back_ ? i : slabs.count - 1 - i);
    polygon_.clear();
    for (const glm::dvec2& p : hull_of_slab(body, rays, z - half, z + half, margin)) {
      const double stored = (rays.at(p.x, p.y, z).z / extent.z + 0.5) * (layout.slices - 1);
      polygon_.push_back({{p.x, p.y, 1}, stored});
    }
    strips_.add(polygon_, StripBuilder::Between::TwoSlices, z, layout, reach);
  }
}

void PreparedViewport::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const int axis = best_stack(*scene_.volume, rays);
  const ViewRays stack_rays = turned(rays, axis);
  const glm::dvec3 extent = turned(scene_.volume->extent(), axis);
  std::vector<LocalPlane> planes = local_clip_planes(scene_);
  for (LocalPlane& plane : planes) plane.normal = turned(plane.normal, axis);
  const Body body = visible_body(extent, stack_rays, planes);
  const Slabs slabs = slabs_of(body, step_);
  // Fragments that clip their stretch of the ray may lie outside the body: an eighth of a pixel, so that none is
  // missed.
  const glm::dvec2 margin = clips_ ? glm::dvec2(0.25 / width, 0.25 / height) : glm::dvec2(0);
  cut(stack_rays, body, slabs, extent, stacks_.layout(axis), margin);
  VolumeUniforms uniforms = turned(volume_uniforms(scene_, view, width, height), axis);
  stacks_.fill(uniforms);
  uniforms.depth[3] = static_cast<float>(step_);
  uniforms.own[0] = {2.F / static_cast<float>(width), -2.F / static_cast<float>(height), 0,
                     static_cast<float>(stacks_.layout(axis).slices - 1)};
  device.end_zone();
  drawing_.draw(strips_, axis, uniforms, target);
  counters_ = drawing_.counters(strips_, axis);
  counters_["slices"] = slabs.count;
}

class Slices2dViewport final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "slices2d_viewport",
        "Slices perpendicular to the view, cut into strips between the slices of 2D textures",
        "rezksalama2000",
        {parameters::kStep.info(), parameters::kOrder.info(), parameters::kEndSlabs.info(),
         parameters::kClassification.info(), parameters::kOpacityCorrection.info(), parameters::kWeights.info(),
         parameters::kTargetFormat.info(), parameters::kVolumeFormat.info(), parameters::kTableSize.info()},
        {"clip_planes"},
        expected_order};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    return stacks_unsupported(scene, stack_settings_of(values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedViewport>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& slices2d_viewport() {
  static const Slices2dViewport method;
  return method;
}

}  // namespace volumark
