// Time of a scene that calls for no effect, with the programs as they are and with those of a build whose GLSL has
// never heard of any (a backend around another one that exchanges the texts), on gl and vulkan: the two must not differ
// beyond noise. Frames of the two in blocks ABBA; process CPU time, which a busy machine disturbs less than wall time.
// stripped_time [SIDE [BLOCKS]]: pixels a side of the picture, ABBA blocks.
#include <fmt/format.h>

#include <cstdlib>
#include <deque>
#include <map>

#include "backends/backend.h"
#include "harness/frame.h"
#include "harness/statistics.h"
#include "methods/method.h"
#include "scenes/scene_io.h"
#include "tests/effects/stripped_text.h"

namespace volumark {
namespace {

class StrippingBackend final : public Backend {
 public:
  StrippingBackend(std::unique_ptr<Backend> inner, std::vector<std::string> effects)
      : inner_(std::move(inner)), effects_(std::move(effects)) {}

  void create_program(uint32_t id, const ProgramDesc& desc) override {
    ProgramDesc stripped = desc;
    for (const ShaderText*& stage : stripped.stages) {
      glsl_.push_back(glsl_without(*stage, effects_));
      spirv_.push_back(spirv_without(*stage, effects_));
      texts_.push_back({stage->name, stage->stage, glsl_.back().c_str(), spirv_.back()});
      stage = &texts_.back();
    }
    inner_->create_program(id, stripped);
  }

  const BackendInfo& info() const override { return inner_->info(); }
  void create_buffer(uint32_t id, const BufferDesc& desc) override { inner_->create_buffer(id, desc); }
  void create_texture(uint32_t id, const TextureDesc& desc) override { inner_->create_texture(id, desc); }
  void create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc, const ProgramDesc& of) override {
    inner_->create_pipeline(id, program, desc, of);
  }
  void destroy_buffer(uint32_t id) override { inner_->destroy_buffer(id); }
  void destroy_texture(uint32_t id) override { inner_->destroy_texture(id); }
  void destroy_program(uint32_t id) override { inner_->destroy_program(id); }
  void destroy_pipeline(uint32_t id) override { inner_->destroy_pipeline(id); }
  void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) override {
    inner_->update_buffer(id, offset, data);
  }
  void begin_pass(const ResolvedPass& pass) override { inner_->begin_pass(pass); }
  void draw(const ResolvedDraw& draw) override { inner_->draw(draw); }
  void end_pass() override { inner_->end_pass(); }
  void dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) override {
    inner_->dispatch(program, bindings, groups);
  }
  void begin_zone(const std::string& name) override { inner_->begin_zone(name); }
  void end_zone() override { inner_->end_zone(); }
  std::vector<ZoneTime> submit_and_wait() override { return inner_->submit_and_wait(); }
  void read_texture(uint32_t id, std::span<std::byte> out) override { inner_->read_texture(id, out); }
  void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) override {
    inner_->read_buffer(id, offset, out);
  }

 private:
  std::unique_ptr<Backend> inner_;
  std::vector<std::string> effects_;
  std::deque<std::string> glsl_;  // deques: the texts point into them
  std::deque<std::vector<uint32_t>> spirv_;
  std::deque<ShaderText> texts_;
};

Device stripped_device(const std::string& id, const std::vector<std::string>& effects) {
  for (const BackendEntry& entry : backend_list())
    if (id == entry.id) return Device(std::make_unique<StrippingBackend>(entry.make({}), effects));
  throw std::invalid_argument("no backend " + id);
}

void compare(const Scene& scene, const Method& method, const std::string& backend, int side, int blocks) {
  const Values values = default_values(method.info().parameters);
  Device full = make_device(backend), bare = stripped_device(backend, method.info().effects);
  FrameSource sources[2] = {{scene, method, values, full, side, side}, {scene, method, values, bare, side, side}};
  const View& view = scene.views.front();
  for (FrameSource& source : sources) source.frame(view);  // compiles
  std::vector<double> seconds[2];
  for (int block = 0; block < blocks; ++block)
    for (const int which : {0, 1, 1, 0}) seconds[which].push_back(sources[which].frame(view).cost.cpu);
  const Stats a = stats_of(seconds[0]), b = stats_of(seconds[1]);
  const bool touch = a.median_lo <= b.median_hi && b.median_lo <= a.median_hi;
  fmt::print("{:<18} {:<8} {:8.3f} [{:.3f}, {:.3f}] {:8.3f} [{:.3f}, {:.3f}] {:+6.2f} %  {}\n", method.info().name,
             backend, 1e3 * a.median, 1e3 * a.median_lo, 1e3 * a.median_hi, 1e3 * b.median, 1e3 * b.median_lo,
             1e3 * b.median_hi, 100 * (a.median / b.median - 1), touch ? "within noise" : "DIFFERS");
  std::fflush(stdout);
}

}  // namespace
}  // namespace volumark

int main(int argc, char** argv) {
  using namespace volumark;
  const int side = argc > 1 ? std::atoi(argv[1]) : 192, blocks = argc > 2 ? std::atoi(argv[2]) : 20;
  if (side < 1 || blocks < 1) {
    fmt::print(stderr, "usage: stripped_time [SIDE [BLOCKS]]\n");
    return 2;
  }
  const Scene scene = load_scene("cloud", data_options_from_environment());
  fmt::print("CPU ms a frame of {} at {}x{}: as it is, and in a build that knows no effect (median, 95 %)\n",
             scene.name, side, side);
  for (const Method* method : method_list())
    for (const char* backend : {"gl", "vulkan"}) compare(scene, *method, backend, side, blocks);
  return 0;
}
