// What a hard case works with: the method and the backend under test, scenes drawn by them, and the rows that it adds.
// Lives for one case on one method and backend.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/frame.h"
#include "harness/verify/scene_shelf.h"
#include "harness/verify/verify.h"

namespace volumark {

// Ends the case for this method: there is nothing to test, and why.
class NotApplicable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A parameter and its value. A name that the method lacks ends the case as not applicable.
using Settings = std::vector<std::pair<std::string, Value>>;

// One number against its expected value.
struct Check {
  std::string check;  // what is measured
  double expected = 0, measured = 0;
  double bound = 0;    // on |measured - expected|
  std::string source;  // of the bound
};

// An interval that holds what a pixel's channel may be, and the value without any error.
struct Allowed {
  double value = 0, lo = 0, hi = 0;
};
inline Allowed within(double value, double bound) { return {value, value - bound, value + bound}; }

// A row and the pictures that show it.
struct VerifyRow {
  HardCaseRow row;
  std::shared_ptr<const Image> picture, expected;
};

class CaseRun {
 public:
  // method and device: null where the case needs none. `others`: for Backends, all devices by their id.
  struct Given {
    const HardCase* hard_case = nullptr;
    const Method* method = nullptr;
    Device* device = nullptr;
    std::vector<std::pair<std::string, Device*>> devices;
    SceneShelf* scenes = nullptr;
    const DataOptions* data = nullptr;
    std::string command;
  };
  explicit CaseRun(Given given) : given_(std::move(given)) {}

  const Method& method() const { return *given_.method; }
  Device& device() { return *given_.device; }
  const std::vector<std::pair<std::string, Device*>>& devices() const { return given_.devices; }
  SceneShelf& scenes() const { return *given_.scenes; }
  const DataOptions& data() const { return *given_.data; }

  // The method's defaults with these set; parameters whose aspect is early termination are ideal, since the threshold
  // is a jump of its own. `step` is in voxels and sets the quality axis. Throws NotApplicable.
  Values values(const Settings& settings) const;
  // A method whose axis counts slices in percent of the stored ones gets the nearest whole number of them.
  Values stepped(double step, Settings settings = {}) const;
  // Whether the step is taken as given, and slabs begin where the volume does: n slices are n slabs.
  bool steps_exactly() const;
  // For pictures of whole scenes: the step is one voxel, or what cuts the diagonal into about a hundred segments. Of
  // methods without steps, and of shells: the method's own defaults.
  Values scene_values(const Scene& scene) const;
  bool has(const std::string& parameter, const Value& value) const;

  // A scene made ready for many views. Throws NotApplicable with the reason where the method cannot draw it.
  std::unique_ptr<FrameSource> prepare(const Scene& scene, const Values& values, int width, int height);
  std::unique_ptr<FrameSource> prepare(const Scene& scene, const Values& values, int width, int height, Device& device);
  Image draw(const Scene& scene, const Values& values, const View& view, int width, int height);

  void add(const Check& check);
  // Every channel of every pixel within allowed(x, y, channel); one row for the worst pixel.
  template <class F>
  void add_picture(const std::string& check, const Image& image, const std::string& source, const F& allowed);
  // Two pictures that may differ by `bound` in every channel.
  void add_equal(const std::string& check, const Image& image, const Image& expected, double bound,
                 const std::string& source);
  void not_applicable(const std::string& check, const std::string& reason);
  void error(const std::string& reason);
  // Outcome and deviation are the caller's; the pictures, where there are any, show it.
  void add_row(HardCaseRow row, const Image* picture = nullptr, const Image* expected = nullptr);
  HardCaseRow new_row(const std::string& check, const std::string& source) const;

  std::vector<VerifyRow> take() { return std::move(rows_); }
  bool empty() const { return rows_.empty(); }

 private:
  void add_worst(const std::string& check, const Image& image, std::shared_ptr<const Image> expected,
                 const std::vector<Allowed>& allowed, const std::string& source);
  Given given_;
  std::vector<VerifyRow> rows_;
};

template <class F>
void CaseRun::add_picture(const std::string& check, const Image& image, const std::string& source, const F& allowed) {
  std::vector<Allowed> all;
  all.reserve(image.rgba.size());
  auto expected = std::make_shared<Image>(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int channel = 0; channel < 4; ++channel) {
        all.push_back(allowed(x, y, channel));
        expected->pixel(x, y)[channel] = static_cast<float>(all.back().value);
      }
  add_worst(check, image, std::move(expected), all, source);
}

}  // namespace volumark
