#include "backends/cpu/cpu_backend.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/version.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "backends/cpu/binning.h"
#include "backends/cpu/tile_raster.h"

namespace volumark {
namespace {

// The most threads one may ask for: beyond that it is a mistake.
constexpr int kMostThreads = 1024;

// Runs `work`, turning a refused allocation into the Device's error.
template <class Work>
auto guard_memory(std::string_view call, std::string_view label, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw DeviceError(DeviceErrorKind::OutOfMemory, call, label, "the host has not enough memory");
  }
}

int thread_count(const DeviceOptions& options) {
  if (options.threads < 0 || options.threads > kMostThreads) {
    throw DeviceError(DeviceErrorKind::BadArgument, "make_device", "cpu",
                      "threads = " + std::to_string(options.threads) + " is not in 0.." + std::to_string(kMostThreads));
  }
  return options.threads > 0 ? options.threads : tbb::info::default_concurrency();
}

BackendInfo make_info(int threads) {
  BackendInfo info;
  info.id = "cpu";
  info.api = "volumark tile rasterizer";
  info.vendor = "volumark";
  info.renderer = std::string("CPU, ") + chosen_simd_name();
  info.version = "1";
  info.driver = std::string("Highway and oneTBB ") + TBB_runtime_version();
  info.simd_bits = chosen_simd_bits();
  info.threads = threads;
  info.software = true;
  info.limits = {16384, 16384, 2048, size_t{1} << 31};
  info.capabilities = {Capability::Compute, Capability::StorageImages, Capability::Float64};
  info.absent = {{Capability::GeometryStage, "the cpu twin has no geometry program"},
                 {Capability::GpuTimers, "the work runs on the host: zones are wall-clock times"}};
  return info;
}

}  // namespace

CpuBackend::CpuBackend(const DeviceOptions& options)
    : threads_(thread_count(options)),
      arena_(threads_),
      info_(make_info(threads_)),
      budget_(std::make_shared<MemoryBudget>(physical_memory_bytes() / 10 * 9)) {
  if (threads_ > tbb::info::default_concurrency()) {
    more_threads_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads_));
  }
}

// ---- Objects --------------------------------------------------------------------------------------------------------

void CpuBackend::create_buffer(uint32_t id, const BufferDesc& desc) {
  guard_memory("create_buffer", desc.label, [&] {
    auto block = std::make_unique<Block>(desc.size, budget_);
    std::ranges::copy(desc.data, block->data());
    buffers_[id] = std::move(block);
  });
}

void CpuBackend::create_texture(uint32_t id, const TextureDesc& desc) {
  guard_memory("create_texture", desc.label, [&] { textures_[id] = std::make_shared<TextureStorage>(desc, budget_); });
}

void CpuBackend::create_program(uint32_t id, const ProgramDesc& desc) {
  const auto refuse = [&](const std::string& why) {
    throw DeviceError(DeviceErrorKind::CompileFailed, "create_program", desc.label, why);
  };
  if (desc.cpu == nullptr) {
    refuse("the program has no cpu twin");
  }
  std::vector<int32_t> constants;
  for (const SpecConstant& constant : desc.constants) {
    constants.push_back(constant.value);
  }
  const CpuKernels kernels = desc.cpu->specialise(constants);
  const bool compute = desc.stages.front()->stage == Stage::Compute;
  if (compute ? kernels.compute == nullptr : kernels.vertex == nullptr || kernels.fragment == nullptr) {
    refuse(std::string("twin '") + desc.cpu->name + "' lacks a kernel for a stage of the program");
  }
  if (kernels.varyings < 0 || kernels.varyings > kMaxVaryings) {
    refuse(std::string("twin '") + desc.cpu->name + "' has " + std::to_string(kernels.varyings) +
           " varyings, at most " + std::to_string(kMaxVaryings));
  }
  programs_[id] = kernels;
}

void CpuBackend::create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc, const ProgramDesc&) {
  pipelines_[id] = {desc, programs_.at(program)};
}

void CpuBackend::update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) {
  std::ranges::copy(data, buffers_.at(id)->data() + offset);
}

CpuBindings CpuBackend::resolve(std::span<const BoundResource> bindings) {
  CpuBindings result;
  for (const BoundResource& bound : bindings) {
    if (bound.kind == BindingKind::Uniform || bound.kind == BindingKind::Storage) {
      result.buffers[bound.slot] = {buffers_.at(bound.object)->data() + bound.offset, bound.size};
      continue;
    }
    TextureStorage& texture = *textures_.at(bound.object);
    texture.refresh_padding();
    result.textures[bound.slot] = texture.view(bound.sampler);
  }
  return result;
}

// ---- Work -----------------------------------------------------------------------------------------------------------

void CpuBackend::begin_pass(const ResolvedPass& pass) {
  work_.desc = *pass.desc;
  work_.width = pass.width;
  work_.height = pass.height;
  work_.tiles_x = (pass.width + kTile - 1) / kTile;
  work_.tiles_y = (pass.height + kTile - 1) / kTile;
  work_.colour = textures_.at(pass.colour);
  work_.depth_stencil = pass.has_depth_stencil ? textures_.at(pass.depth_stencil) : nullptr;
  work_.draws.clear();
  work_.triangles.clear();
  work_.planes.clear();
}

void CpuBackend::draw(const ResolvedDraw& draw) {
  const PipelineState& pipeline = pipelines_.at(draw.pipeline);
  DrawInput input;
  for (const uint32_t buffer : draw.vertex_buffers) {
    input.vertex_buffers.emplace_back(buffers_.at(buffer)->data(), buffers_.at(buffer)->size());
  }
  input.indexed = draw.indexed;
  if (draw.indexed) {
    input.index_buffer = {buffers_.at(draw.index_buffer)->data(), buffers_.at(draw.index_buffer)->size()};
  }
  input.first = draw.first;
  input.count = draw.count;
  input.instances = draw.instances;
  guard_memory("draw", pipeline.desc.label, [&] {
    auto state = std::make_unique<DrawState>();
    state->bindings = resolve(draw.bindings);
    state->kernels = pipeline.kernels;
    state->pipeline = pipeline.desc;
    state->tests_depth_stencil = pipeline.desc.depth_test || pipeline.desc.stencil_test;
    const size_t triangles = work_.triangles.size(), planes = work_.planes.size();
    work_.draws.push_back(std::move(state));
    try {
      arena_.execute([&] { run_vertex_stage(work_, input, vertex_scratch_); });
    } catch (...) {  // a refused draw changes nothing
      work_.triangles.resize(triangles);
      work_.planes.resize(planes);
      work_.draws.pop_back();
      throw;
    }
  });
}

void CpuBackend::end_pass() {
  guard_memory("end_pass", work_.desc.label, [&] {
    arena_.execute([&] {
      bin_triangles(work_);
      tbb::parallel_for(
          tbb::blocked_range<int>(0, work_.tiles_x * work_.tiles_y, 1),
          [&](const tbb::blocked_range<int>& tiles) {
            std::unique_ptr<TileScratch>& scratch = tile_scratch_.local();
            if (scratch == nullptr) {
              scratch = std::make_unique<TileScratch>();
            }
            for (int tile = tiles.begin(); tile != tiles.end(); ++tile) {
              raster_tile(work_, tile % work_.tiles_x, tile / work_.tiles_x, *scratch);
            }
          },
          tbb::simple_partitioner());
    });
  });
  work_.colour->mark_written();
  work_.colour.reset();
  work_.depth_stencil.reset();
}

void CpuBackend::dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) {
  const CpuKernels& kernels = programs_.at(program);
  const CpuBindings resolved = resolve(bindings);
  const uint64_t count = uint64_t{groups[0]} * groups[1] * groups[2];
  guard_memory("dispatch", "", [&] {
    arena_.execute([&] {
      tbb::parallel_for(uint64_t{0}, count, [&](uint64_t i) {
        const uint64_t rows = i / groups[0];
        kernels.compute(resolved, {static_cast<uint32_t>(i % groups[0]), static_cast<uint32_t>(rows % groups[1]),
                                   static_cast<uint32_t>(rows / groups[1])});
      });
    });
  });
  for (const BoundResource& bound : bindings) {
    if (bound.kind == BindingKind::Image) {
      textures_.at(bound.object)->mark_written();
    }
  }
}

// Passes and dispatches run at once, so a zone is the wall time between its two calls.
void CpuBackend::begin_zone(const std::string& name) {
  zones_.push_back({name, 0});
  open_zones_.emplace_back(zones_.size() - 1, Clock::now());
}

void CpuBackend::end_zone() {
  const auto [zone, began] = open_zones_.back();
  open_zones_.pop_back();
  zones_[zone].seconds = std::chrono::duration<double>(Clock::now() - began).count();
}

std::vector<ZoneTime> CpuBackend::submit_and_wait() { return std::exchange(zones_, {}); }

void CpuBackend::read_texture(uint32_t id, std::span<std::byte> out) { textures_.at(id)->read(out); }

void CpuBackend::read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) {
  std::memcpy(out.data(), buffers_.at(id)->data() + offset, out.size());
}

std::unique_ptr<Backend> make_cpu_backend(const DeviceOptions& options) {
  if (!simd_supported()) {
    throw DeviceError(DeviceErrorKind::MissingCapability, "make_device", "cpu",
                      "this processor lacks the vector instructions it is built for");
  }
  return std::make_unique<CpuBackend>(options);
}

}  // namespace volumark
