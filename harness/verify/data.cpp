// Data at the edge of what is allowed: refused with a clear message, or drawn as defined.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"
#include "scenes/errors.h"

namespace volumark::hard_cases {
namespace {

namespace fs = std::filesystem;

constexpr int kSize = 40;
double opacity(double depth) { return -std::expm1(-std::max(depth, 0.0)); }

const View& slanted() {
  static const View view = perspective({2.1, 1.4, 2.7}, {0, 0, 0});
  return view;
}

// A folder of its own that goes away with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "volumark-verify-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder can be made: " + pattern);
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Reads a raw volume of 2 x 2 x 2 floats; the message of the refusal, or nothing.
std::string refusal_of(const fs::path& folder, const std::vector<float>& values, const std::string& more) {
  std::ofstream(folder / "data.raw", std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
  const std::string text = fmt::format(
      R"({{"volumark_scene": 1, "title": "edge of what is allowed",
           "volume": {{"file": "data.raw", "raw": {{"size": [2, 2, 2], "type": "f32", "endian": "little"}}{}}},
           "transfer": {{"points": [{{"value": 0, "colour": [1, 1, 1], "extinction": 1}}], "window": [0, 1]}},
           "views": [{{"orbit": {{"count": 1, "distance": 3, "fov_y": 40}}}}]}})",
      more);
  try {
    Scene scene = parse_scene(text, (folder / "scene.json").string());
    load_data(scene, DataOptions{});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

// Whether a cell of constant extinction looks as its chord says; places as place_error() has them.
void check_box(CaseRun& run, const std::string& name, const Scene& scene, const Values& values, double tau) {
  const Image image = run.draw(scene, values, slanted(), kSize, kSize);
  const glm::dvec3 half = 0.5 * scene.volume->extent();
  const double moved = place_error(kSize), rounding = 40 * 0x1p-23 + 4 * moved * tau;
  run.add_picture(
      name, image, "faces moved by pixels 2^-23 of the box; n blends round once each", [&](int x, int y, int) {
        const Ray ray = pixel_ray(slanted(), kSize, kSize, x, y);
        const double exact = opacity(tau * box_chord(ray, half).length());
        const auto of_box = [&](double grow) { return opacity(tau * box_chord(ray, half + grow).length()); };
        return Allowed{exact, of_box(-moved) - rounding, of_box(moved) + rounding};
      });
}

}  // namespace

void refused_data(CaseRun& run) {
  const TemporaryFolder folder;
  const auto values = [](float last) { return std::vector<float>{0, 1, 0, 1, 0, 1, 0, last}; };
  const auto check = [&](const std::string& name, const std::string& message, const std::string& wanted) {
    const bool named = message.find(wanted) != std::string::npos;
    run.add({.check = name,
             .expected = 1,
             .measured = named ? 1. : 0.,
             .bound = 0,
             .source = fmt::format("refused with a message that says \"{}\"; it says \"{}\"", wanted, message)});
  };
  check("NaN is refused", refusal_of(folder.path(), values(std::numeric_limits<float>::quiet_NaN()), ""), "finite");
  check("infinity is refused", refusal_of(folder.path(), values(std::numeric_limits<float>::infinity()), ""), "finite");
  check("a file that is too short is refused", refusal_of(folder.path(), {0, 1, 0}, ""), "bytes");
  run.add({.check = "NaN is read where the scene says it is zero",
           .expected = 1,
           .measured =
               refusal_of(folder.path(), values(std::numeric_limits<float>::quiet_NaN()), R"(, "non_finite": "zero")")
                       .empty()
                   ? 1.
                   : 0.,
           .bound = 0,
           .source = "\"non_finite\": \"zero\" in the scene"});
}

void degenerate_volumes(CaseRun& run) {
  const glm::ivec3 sizes[] = {{1, 1, 1}, {1, 9, 9}, {9, 1, 9}, {9, 9, 1}, {1, 1, 9}, {2, 2, 2}};
  for (const glm::ivec3& size : sizes) {
    const Scene scene = scene_of(volume_of(ConstantField{1}, size), homogeneous(0.5));
    check_box(run, fmt::format("{} x {} x {} samples of one value", size.x, size.y, size.z), scene, run.values({}),
              0.5);
  }
}

void isovalue_outside(CaseRun& run) {
  // Data 0 to 1 and a window that is wider: below all of them everything is solid, above none of it.
  const auto scene = [](double value) {
    Scene out = scene_of(volume_of(RampField{0, 0, 1}, glm::ivec3(9)), transfer_of({{0, glm::dvec3(1), 1}}, -2, 3));
    out.isosurface = Isosurface{value, {0.25, 0.5, 0.75}, glm::dvec3(1)};
    out.display = Display::Isosurface;
    return out;
  };
  const double moved = place_error(kSize);
  for (const double value : {1.5, 2.9, 7.0})
    run.add_equal(fmt::format("isovalue {:g}, above all data: exactly nothing", value),
                  run.draw(scene(value), run.values({}), slanted(), kSize, kSize), Image(kSize, kSize), 0,
                  "no sample reaches it");
  for (const double value : {-0.5, -1.9, -7.0})
    run.add_picture(
        fmt::format("isovalue {:g}, below all data: the box, of one colour", value),
        run.draw(scene(value), run.values({}), slanted(), kSize, kSize),
        "rays that hit a box moved by pixels 2^-23 may show it, those that hit one as much smaller must",
        [&](int x, int y, int channel) {
          const Ray ray = pixel_ray(slanted(), kSize, kSize, x, y);
          const double colour = channel == 3 ? 1 : 0.25 * (channel + 1);
          const auto hit = [&](double grow) { return box_chord(ray, glm::dvec3(1 + grow)).length() > 0; };
          return Allowed{hit(0) ? colour : 0, hit(-moved) ? colour - 0x1p-20 : 0, hit(moved) ? colour + 0x1p-20 : 0};
        });
}

void extreme_transfer(CaseRun& run) {
  const Volume ramp = volume_of(RampField{0, 0, 1}, glm::ivec3(9));
  const auto scene = [&](std::vector<TransferPoint> points, const Volume& volume) {
    return scene_of(volume, transfer_of(std::move(points)));
  };
  const Values values = run.stepped(1);
  const Image clear = run.draw(scene({{0, glm::dvec3(1), 0}}, ramp), values, slanted(), kSize, kSize);
  run.add_equal("no extinction: exactly nothing", clear, Image(kSize, kSize), 0, "0 times anything");
  check_box(run, "extinction 1e6: opaque, finite, of its own colour", scene({{0, glm::dvec3(1), 1e6}}, ramp), values,
            1e6);
  check_box(run, "extinction 1e-40 (no float): nothing", scene({{0, glm::dvec3(1), 1e-40}}, ramp), values, 0);
  // Values outside of the points and of the window read the ends.
  Volume beyond = volume_of(std::vector<float>(27, 7.5F), glm::ivec3(3), glm::dvec3(1));
  check_box(run, "values above the window read its end",
            scene({{0, glm::dvec3(1), 0}, {1, glm::dvec3(1), 0.4}}, beyond), values, 0.4);
  beyond = volume_of(std::vector<float>(27, -7.5F), glm::ivec3(3), glm::dvec3(1));
  check_box(run, "values below the window read its begin",
            scene({{0, glm::dvec3(1), 0.3}, {1, glm::dvec3(1), 9}}, beyond), values, 0.3);
  // Denormal samples are small numbers, or zero where a driver flushes them: both read the same extinction.
  std::vector<float> tiny(27, std::numeric_limits<float>::denorm_min());
  for (size_t i = 0; i < tiny.size(); i += 2) tiny[i] = 0x1p-130F;
  check_box(run, "denormal samples",
            scene({{0, glm::dvec3(1), 0.3}, {1, glm::dvec3(1), 9}}, volume_of(tiny, glm::ivec3(3), glm::dvec3(1))),
            values, 0.3);
  // A step of the transfer function in a linear field: half of the box; sampled to within one step, smeared over one
  // interval of the table.
  const Scene step = scene({{0.5, glm::dvec3(1), 0}, {0.5, glm::dvec3(1), 1.5}}, ramp);
  const View along = orthographic({-1, 0, 0}, 1.4);
  const Image image = run.draw(step, run.stepped(0.25), along, kSize, kSize);
  run.add_picture("a step half way through a linear field", image, "one step of sampling, one interval of the table",
                  [&](int x, int y, int) {
                    const bool hit = box_chord(pixel_ray(along, kSize, kSize, x, y), glm::dvec3(1)).length() > 0;
                    const double slack = 0.25 * 0.25 + 2. / 1020;
                    return hit ? Allowed{opacity(1.5), opacity(1.5 * (1 - slack)) - 1e-6,
                                         opacity(1.5 * (1 + slack)) + 1e-6}
                               : Allowed{};
                  });
}

}  // namespace volumark::hard_cases
