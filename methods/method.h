// How to draw: one technique with typed parameters. The harness owns clock, repetitions and stopping; a method never
// measures itself beyond naming zones (classify, upload, raster, shade) on the Device.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "backends/device.h"
#include "methods/parameters.h"
#include "scenes/scene.h"

namespace volumark {

// What a method says of its own work, exact and repeatable: slices, polygons, vertices, samples, bytes ...
using Counters = std::map<std::string, int64_t>;

// A case of the stability suite (`volumark verify`) that a method cannot take, and why. It is printed, never silent:
// all other cases apply.
struct CaseExemption {
  std::string id, reason;
};

struct MethodInfo {
  std::string name;   // snake_case
  std::string title;  // one line
  std::string paper;  // key in papers/, or a citation
  std::vector<ParameterInfo> parameters;
  std::vector<std::string> effects;  // that it can simulate
  // Expected order of convergence along the quality axis on smooth fields with the given values; 0 = not stated.
  double (*expected_order)(const Values&) = nullptr;
  std::vector<CaseExemption> exempt = {};             // from hard cases
  std::vector<Display> displays = {Display::Direct};  // what of a scene it draws
};

// A method made ready for one scene, one set of values and one Device. Dies before the Device.
class PreparedMethod {
 public:
  virtual ~PreparedMethod() = default;
  // Records the drawing of `view` into `target` (a colour target of target_format; cleared to 0 here): premultiplied,
  // over transparent black. The caller submits.
  virtual void render(const View& view, Device& device, Texture target) = 0;
  virtual Counters counters() const = 0;  // of the last render
};

class Method {
 public:
  virtual ~Method() = default;
  virtual const MethodInfo& info() const = 0;
  // Why this cell cannot be drawn; nothing where it can. Effects and parameters are checked here, before any work.
  // Called through unsupported_reason(), which also checks the effects against info().effects.
  virtual std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                                 const BackendInfo& backend) const = 0;
  // Everything that does not depend on the view. `scene.volume` is loaded.
  virtual std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const = 0;
  virtual Format target_format(const Values& values) const = 0;  // where the scene does not decide it
};

// The format of the target that render() draws `scene` into: RGBA8 where it calls for fixed_point, whose frame buffer
// has 8 bits a channel; otherwise the method's.
Format target_format(const Method& method, const Scene& scene, const Values& values);

// Why this cell cannot be drawn; nothing where it can. "effect NAME: why" where it could be without that effect.
std::optional<std::string> unsupported_reason(const Method& method, const Scene& scene, const Values& values,
                                              const BackendInfo& backend);

// The effects that `method` simulates in no scene, of those that are called for: known before data, references or a
// Device are there.
std::vector<std::string> missing_effects(const Method& method, const Effects& effects);
// Why `method` cannot draw what the scene shows; nothing where it can. Known before any work, and no effect is to
// blame.
std::optional<std::string> display_reason(const Method& method, const Scene& scene);
// The part of unsupported_reason() that follows from missing_effects().
std::optional<std::string> missing_effect_reason(const Method& method, const Effects& effects);

// The effects that must be left out so that this cell can be drawn. Where leaving out effects does not help, those of
// missing_effects() alone.
std::vector<std::string> effects_to_ignore(const Method& method, const Scene& scene, const Values& values,
                                           const BackendInfo& backend);

// The one list of methods (methods/methods.cpp). Throws ParameterError for an unknown name, with the nearest one.
std::span<const Method* const> method_list();
const Method& find_method(const std::string& name);

}  // namespace volumark
