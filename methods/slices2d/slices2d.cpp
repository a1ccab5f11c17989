#include "methods/slices2d/slices2d.h"

#include "methods/slices2d/fixed_slices2d.h"
#include "methods/slices2d/slice_parameters.h"
#include "programs/slices2d_frag.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using namespace stack_parameters;
}  // namespace parameters

bool linear_opacity(const Values& values) { return parameters::kOpacityCorrection(values) == "linear"; }

SliceSettings slice_settings_of(const Values& values) {
  SliceSettings settings;
  settings.percent = parameters::kSlices(values);
  settings.textures = 1 << parameters::kTexturesPerPolygon.index(values);
  settings.interpolate = parameters::kInterpolation(values);
  settings.slant = parameters::kSlantCorrection(values);
  settings.corrected = settings.textures == 1 || parameters::kTextureCoordinates(values) == "corrected";
  return settings;
}

double expected_order(const Values& values) {
  // Formats with few bits have an error that no number of slices removes; pre-classified volumes, slices that are not
  // interpolated and textures that are not corrected tend to other pictures.
  const std::string& format = parameters::kVolumeFormat(values);
  const SliceSettings settings = slice_settings_of(values);
  if (stack_classification_of(values) == Classification::Pre || parameters::kTargetFormat(values) != "rgba32f" ||
      (format != "native" && format != "r32f") || !settings.interpolate || !settings.corrected || !settings.slant) {
    return 0;
  }
  return linear_opacity(values) ? 1 : 2;
}

class PreparedSlices2d final : public PreparedMethod {
 public:
  PreparedSlices2d(const Scene& scene, const Values& values, Device& device)
      : stacks_(scene, stack_settings_of(values), device),
        drawing_(scene, stacks_, slice_settings_of(values),
                 slices2d_program(scene, stack_classification_of(values), linear_opacity(values)),
                 target_format_of(values), device) {}

  void render(const View& view, Device& device, Texture target) override { drawing_.render(view, device, target); }
  Counters counters() const override { return drawing_.counters(); }

 private:
  SliceStacks stacks_;
  SliceDrawing drawing_;
};

class Slices2d final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "slices2d",
        "Object-aligned slices of 2D textures, the stack chosen for each view, blended back to front",
        "rezksalama2000",
        {parameters::kSlices.info(), parameters::kTexturesPerPolygon.info(), parameters::kTextureCoordinates.info(),
         parameters::kInterpolation.info(), parameters::kSlantCorrection.info(),
         stack_parameters::kClassification.info(), parameters::kOpacityCorrection.info(),
         parameters::kTargetFormat.info(), parameters::kVolumeFormat.info(), parameters::kTableSize.info()},
        {"clip_planes", "fixed_point"},
        expected_order};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    if (auto reason = fixed_point_unsupported(scene, stack_classification_of(values))) return reason;
    return stacks_unsupported(scene, stack_settings_of(values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    if (scene.effects.fixed_point) {
      return prepare_fixed_slices2d(scene, slice_settings_of(values), stack_classification_of(values),
                                    linear_opacity(values), device);
    }
    return std::make_unique<PreparedSlices2d>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

ProgramDesc slices2d_program(const Scene& scene, Classification classification, bool linear_opacity) {
  ProgramDesc program;
  program.label = "slices2d";
  program.stages = {&programs::slices2d_frag};
  program.bindings = SliceStacks::declarations();
  program.constants = VolumeResources::constants(scene, classification, linear_opacity);
  program.cpu = &slices2d_twin;
  return program;
}

const Method& slices2d() {
  static const Slices2d method;
  return method;
}

}  // namespace volumark
