// The cpu backend: draws of a pass are recorded, their triangles binned to tiles, and the tiles drawn by oneTBB workers
// when the pass ends. The image has the same bits for any number of threads. Programs run as their CPU twins.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <optional>
#include <unordered_map>

#include "backends/backend.h"
#include "backends/cpu/raster_types.h"
#include "backends/cpu/vertex_stage.h"

namespace volumark {

class CpuBackend final : public Backend {
 public:
  explicit CpuBackend(const DeviceOptions& options);

  const BackendInfo& info() const override { return info_; }
  void create_buffer(uint32_t id, const BufferDesc& desc) override;
  void create_texture(uint32_t id, const TextureDesc& desc) override;
  void create_program(uint32_t id, const ProgramDesc& desc) override;
  void create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc,
                       const ProgramDesc& program_desc) override;
  void destroy_buffer(uint32_t id) override { buffers_.erase(id); }
  void destroy_texture(uint32_t id) override { textures_.erase(id); }
  void destroy_program(uint32_t id) override { programs_.erase(id); }
  void destroy_pipeline(uint32_t id) override { pipelines_.erase(id); }
  void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) override;
  void begin_pass(const ResolvedPass& pass) override;
  void draw(const ResolvedDraw& draw) override;
  void end_pass() override;
  void dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) override;
  void begin_zone(const std::string& name) override;
  void end_zone() override;
  std::vector<ZoneTime> submit_and_wait() override;
  void read_texture(uint32_t id, std::span<std::byte> out) override;
  void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct PipelineState {
    PipelineDesc desc;
    CpuKernels kernels;
  };

  CpuBindings resolve(std::span<const BoundResource> bindings);

  int threads_;
  std::optional<tbb::global_control> more_threads_;  // only where more than the machine has are asked for
  tbb::task_arena arena_;
  BackendInfo info_;
  std::shared_ptr<MemoryBudget> budget_;
  std::unordered_map<uint32_t, std::unique_ptr<Block>> buffers_;
  std::unordered_map<uint32_t, std::shared_ptr<TextureStorage>> textures_;
  std::unordered_map<uint32_t, CpuKernels> programs_;
  std::unordered_map<uint32_t, PipelineState> pipelines_;
  PassWork work_;
  VertexScratch vertex_scratch_;
  tbb::enumerable_thread_specific<std::unique_ptr<TileScratch>> tile_scratch_;
  std::vector<ZoneTime> zones_;
  std::vector<std::pair<size_t, Clock::time_point>> open_zones_;  // index into zones_, when it began
};

}  // namespace volumark
