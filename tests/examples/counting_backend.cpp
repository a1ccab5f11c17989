#include "tests/examples/counting_backend.h"

namespace volumark {
namespace {

class CountingBackend final : public Backend {
 public:
  CountingBackend(std::unique_ptr<Backend> inner, BackendCounts& counts)
      : inner_(std::move(inner)), counts_(counts), info_(inner_->info()) {
    info_.id = "counting_" + info_.id;
  }

  const BackendInfo& info() const override { return info_; }

  void create_buffer(uint32_t id, const BufferDesc& desc) override {
    inner_->create_buffer(id, desc);
    counts_.uploaded += desc.data.size();
  }
  void create_texture(uint32_t id, const TextureDesc& desc) override {
    inner_->create_texture(id, desc);
    counts_.uploaded += desc.data.size();
  }
  void create_program(uint32_t id, const ProgramDesc& desc) override { inner_->create_program(id, desc); }
  void create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc,
                       const ProgramDesc& program_desc) override {
    inner_->create_pipeline(id, program, desc, program_desc);
  }
  void destroy_buffer(uint32_t id) override { inner_->destroy_buffer(id); }
  void destroy_texture(uint32_t id) override { inner_->destroy_texture(id); }
  void destroy_program(uint32_t id) override { inner_->destroy_program(id); }
  void destroy_pipeline(uint32_t id) override { inner_->destroy_pipeline(id); }

  void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) override {
    inner_->update_buffer(id, offset, data);
    counts_.uploaded += data.size();
  }
  void begin_pass(const ResolvedPass& pass) override {
    inner_->begin_pass(pass);
    ++counts_.passes;
  }
  void draw(const ResolvedDraw& draw) override {
    inner_->draw(draw);
    ++counts_.draws;
    counts_.vertices += int64_t{draw.count} * draw.instances;
  }
  void end_pass() override { inner_->end_pass(); }
  void dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) override {
    inner_->dispatch(program, bindings, groups);
  }
  void begin_zone(const std::string& name) override { inner_->begin_zone(name); }
  void end_zone() override { inner_->end_zone(); }
  std::vector<ZoneTime> submit_and_wait() override {
    ++counts_.submissions;
    return inner_->submit_and_wait();
  }
  void read_texture(uint32_t id, std::span<std::byte> out) override {
    inner_->read_texture(id, out);
    counts_.read_back += out.size();
  }
  void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) override {
    inner_->read_buffer(id, offset, out);
    counts_.read_back += out.size();
  }

 private:
  std::unique_ptr<Backend> inner_;
  BackendCounts& counts_;
  BackendInfo info_;
};

}  // namespace

std::unique_ptr<Backend> make_counting_backend(std::unique_ptr<Backend> inner, BackendCounts& counts) {
  return std::make_unique<CountingBackend>(std::move(inner), counts);
}

}  // namespace volumark
