// What the comparison with other programs needs of volumark (compare.py starts it):
//   peers_driver dump SCENE DIR           scene.json (geometry, transfer function, view 0), voxels.raw (float32),
//                                         reference.raw (RGBA float32, rows from the top)
//   peers_driver draw SCENE METHOD BACKEND FRAMES OUT.raw [name=value ...]
//                                         RGBA float32; CPU seconds of each frame, read-back included, on stdout
// One thread each, but for the reference.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "methods/method.h"
#include "methods/reference/reference.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

using Json = nlohmann::ordered_json;

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void write_raw(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

Json vector_of(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json describe(const Scene& scene) {
  const Volume& volume = *scene.volume;
  Json points = Json::array();
  for (const TransferPoint& point : scene.transfer.points) {
    points.push_back({{"value", point.value}, {"colour", vector_of(point.colour)}, {"extinction", point.extinction}});
  }
  const View& view = scene.views.front();
  return {{"size", Json::array({volume.size.x, volume.size.y, volume.size.z})},
          {"spacing", vector_of(volume.spacing)},
          {"origin", vector_of(volume.origin)},
          {"width", scene.width},
          {"height", scene.height},
          {"transfer", {{"lo", scene.transfer.lo}, {"hi", scene.transfer.hi}, {"points", points}}},
          {"view",
           {{"eye", vector_of(view.eye)},
            {"target", vector_of(view.target)},
            {"up", vector_of(view.up)},
            {"half_height", view.half_height}}}};
}

void dump(const Scene& scene, const std::filesystem::path& folder) {
  const Volume& volume = *scene.volume;
  const View& view = scene.views.front();
  if (view.perspective || volume.axes != glm::dmat3(1) || !effect_names(scene.effects).empty()) {
    throw std::runtime_error("peers are compared on orthographic views of upright volumes without effects");
  }
  std::filesystem::create_directories(folder);
  std::vector<float> voxels;
  for (int k = 0; k < volume.size.z; ++k) {
    for (int j = 0; j < volume.size.y; ++j) {
      for (int i = 0; i < volume.size.x; ++i) voxels.push_back(static_cast<float>(volume.at(i, j, k)));
    }
  }
  write_raw(folder / "voxels.raw", bytes_of(voxels));
  const Reference reference = render_reference(scene, view, scene.width, scene.height);
  write_raw(folder / "reference.raw", bytes_of(reference.image.rgba));
  Json json = describe(scene);
  json["reference_bound"] = reference.max_bound;
  std::ofstream(folder / "scene.json") << json.dump(1) << "\n";
}

void draw(const Scene& scene, const Method& method, const Values& values, Device& device, int frames,
          const std::filesystem::path& out) {
  if (const auto why = unsupported_reason(method, scene, values, device.info())) throw std::runtime_error(*why);
  const auto prepared = method.prepare(scene, values, device);
  if (method.target_format(values) != Format::RGBA32F) throw std::runtime_error("target_format is not rgba32f");
  const Texture target = device.create_texture({.label = "target",
                                                .format = Format::RGBA32F,
                                                .width = scene.width,
                                                .height = scene.height,
                                                .target = true,
                                                .data = {}});
  std::vector<double> seconds;
  std::vector<std::byte> texels;
  constexpr int kWarmUp = 2;
  for (int frame = 0; frame < kWarmUp + frames; ++frame) {
    const double start = cpu_seconds();
    prepared->render(scene.views.front(), device, target);
    device.submit_and_wait();
    texels = device.read_texture(target);
    if (frame >= kWarmUp) seconds.push_back(cpu_seconds() - start);
  }
  write_raw(out, texels);
  const Json json = {{"cpu_seconds", seconds},
                     {"driver", device.info().renderer},
                     {"simd_bits", device.info().simd_bits},
                     {"counters", prepared->counters()}};
  std::puts(json.dump().c_str());
}

int run(std::span<char*> arguments) {
  const std::string command = arguments.size() > 1 ? arguments[1] : "";
  if (command == "dump" && arguments.size() == 4) {
    dump(load_scene(arguments[2], data_options_from_environment()), arguments[3]);
    return 0;
  }
  if (command == "draw" && arguments.size() >= 7) {
    const Scene scene = load_scene(arguments[2], data_options_from_environment());
    const Method& method = find_method(arguments[3]);
    Values values = default_values(method.info().parameters);
    for (const char* setting : arguments.subspan(7)) {
      const std::string text = setting;
      const size_t equals = text.find('=');
      if (equals == std::string::npos) throw std::runtime_error(text + ": name=value is wanted");
      set_value(method.info().parameters, values, text.substr(0, equals), text.substr(equals + 1));
    }
    DeviceOptions options;
    options.threads = 1;
    Device device = make_device(arguments[4], options);
    draw(scene, method, values, device, std::stoi(arguments[5]), arguments[6]);
    return 0;
  }
  std::fputs(
      "usage: peers_driver dump SCENE DIR\n"
      "       peers_driver draw SCENE METHOD BACKEND FRAMES OUT.raw [name=value ...]\n",
      stderr);
  return 2;
}

}  // namespace
}  // namespace volumark

int main(int argc, char** argv) {
  try {
    return volumark::run(std::span<char*>(argv, static_cast<size_t>(argc)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peers_driver: %s\n", error.what());
    return 2;
  }
}
