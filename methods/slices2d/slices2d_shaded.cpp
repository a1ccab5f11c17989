#include "methods/slices2d/slices2d_shaded.h"

#include <fmt/format.h>

#include "methods/slices2d/slice_parameters.h"
#include "methods/slices2d/slices2d.h"
#include "methods/volume/gradient_parameters.h"
#include "programs/slices2d_shaded_frag.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using gradient_parameters::kNormals;
using stack_parameters::kInterpolation;
using stack_parameters::kSlices;

const Choice kForm{"form",
                   "full: gradient and value a texel, colour and opacity of the interpolated value; gradient: gradient "
                   "and opacity a texel, one ambient colour for all data; separate: gradient, and ambient colour and "
                   "opacity, in two textures. The last two are the paper's: lights shine on white, nothing is specular",
                   {"full", "gradient", "separate"},
                   "full",
                   Ideal<const char*>{"full", "colour and opacity of voxels"}};

const Choice kGradientFormat{"gradient_format",
                             "texels that hold the gradient (or normal), and with form full or gradient the value or "
                             "opacity; volume_format is that of form separate's colours",
                             {"rgba32f", "rgba16f", "rgba8"},
                             "rgba32f",
                             Ideal<const char*>{"rgba32f", "gradient texture and filter"}};
}  // namespace parameters

ShadedForm form_of(const Values& values) { return static_cast<ShadedForm>(parameters::kForm.index(values)); }
bool linear_opacity(const Values& values) { return parameters::kOpacityCorrection(values) == "linear"; }
bool stored_normals(const Values& values) { return parameters::kNormals(values) == "interpolated"; }

SliceSettings slice_settings_of(const Values& values) {
  SliceSettings settings;
  settings.percent = parameters::kSlices(values);
  settings.interpolate = parameters::kInterpolation(values);
  return settings;
}

double expected_order(const Values& values) {
  // As of slices2d: whatever else tends to another picture.
  if (form_of(values) != ShadedForm::Full || stored_normals(values) || !parameters::kInterpolation(values) ||
      parameters::kGradientFormat(values) != "rgba32f" || parameters::kTargetFormat(values) != "rgba32f") {
    return 0;
  }
  return linear_opacity(values) ? 1 : 2;
}

Classification classification_in(const Values& values) {
  return form_of(values) == ShadedForm::Full ? Classification::Post : Classification::Pre;
}

StackSettings settings_of(const Scene& scene, const Values& values) {
  StackSettings settings;
  settings.volume.volume_format = parameters::kVolumeFormat(values);
  settings.volume.classification = classification_in(values);
  settings.volume.table_size = static_cast<int>(parameters::kTableSize(values));
  if (!scene.effects.lighting) return settings;
  settings.data = form_of(values) == ShadedForm::Separate;
  settings.slots = 2;
  constexpr GradientAlpha kAlpha[] = {GradientAlpha::Scalar, GradientAlpha::Opacity, GradientAlpha::None};
  GradientSettings& gradient = settings.gradient.emplace();
  gradient.normals = stored_normals(values);
  gradient.alpha = kAlpha[parameters::kForm.index(values)];
  gradient.format = parameters::kGradientFormat(values);
  return settings;
}

// The scene as the form lights it: eq. 6 has no specular term.
Scene lit_scene(Scene scene, const Values& values) {
  if (scene.effects.lighting && form_of(values) != ShadedForm::Full) scene.effects.lighting->specular = 0;
  return scene;
}

// Without lighting it is a program of slices2d, which knows nothing of it.
ProgramDesc program_of(const Scene& scene, const Values& values) {
  ProgramDesc program = slices2d_program(scene, classification_in(values), linear_opacity(values));
  if (!scene.effects.lighting) return program;
  program.label = "slices2d_shaded";
  program.stages = {&programs::slices2d_shaded_frag};
  program.bindings = SliceStacks::declarations(2);
  program.constants.push_back({"VM_FORM", static_cast<int32_t>(form_of(values))});
  program.constants.push_back({"VM_NORMALS", stored_normals(values) ? 1 : 0});
  program.cpu = &slices2d_shaded_twin;
  return program;
}

class PreparedShaded final : public PreparedMethod {
 public:
  PreparedShaded(const Scene& scene, const Values& values, Device& device)
      : stacks_(scene, settings_of(scene, values), device),
        drawing_(lit_scene(scene, values), stacks_, slice_settings_of(values),
                 program_of(lit_scene(scene, values), values), target_format_of(values), device) {}

  void render(const View& view, Device& device, Texture target) override { drawing_.render(view, device, target); }
  Counters counters() const override { return drawing_.counters(); }

 private:
  SliceStacks stacks_;
  SliceDrawing drawing_;
};

// What the combiners of the paper's forms cannot do; nothing for form full.
std::optional<std::string> form_unsupported(const Scene& scene, const Values& values) {
  const ShadedForm form = form_of(values);
  if (form == ShadedForm::Full) return std::nullopt;
  if (!scene.effects.lighting) {
    if (form == ShadedForm::Separate) return std::nullopt;
    return "form gradient has no colours but those of lights, and the scene calls for none";
  }
  // Section 7: a second light takes the registers that interpolation needs.
  const size_t most = form == ShadedForm::Gradient && parameters::kInterpolation(values) ? 1 : 2;
  const std::vector<Light>& lights = scene.effects.lighting->lights;
  if (lights.size() > most) {
    return fmt::format("{} lights, the combiners of form {} have registers for {}{}", lights.size(),
                       parameters::kForm(values), most, most == 1 ? ", or with interpolation=false for 2" : "");
  }
  for (const Light& light : lights) {
    if (light.kind == Light::Kind::Point) {
      return fmt::format("a point light has another direction at every sample, form {} holds one in a register",
                         parameters::kForm(values));
    }
  }
  return std::nullopt;
}

class Slices2dShaded final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "slices2d_shaded",
        "Object-aligned slices of 2D textures with gradients, lit before they are blended",
        "rezksalama2000",
        {parameters::kSlices.info(), parameters::kForm.info(), parameters::kNormals.info(),
         parameters::kInterpolation.info(), parameters::kGradientFormat.info(), parameters::kOpacityCorrection.info(),
         parameters::kTargetFormat.info(), parameters::kVolumeFormat.info(), parameters::kTableSize.info()},
        {"lighting", "clip_planes"},
        expected_order};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    if (auto reason = form_unsupported(scene, values)) return reason;
    if (scene.effects.lighting && scene.effects.lighting->lights.size() > kMaxLights) {
      return fmt::format("{} lights, at most {} are simulated", scene.effects.lighting->lights.size(), kMaxLights);
    }
    return stacks_unsupported(scene, settings_of(scene, values).volume, backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedShaded>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& slices2d_shaded() {
  static const Slices2dShaded method;
  return method;
}

}  // namespace volumark
