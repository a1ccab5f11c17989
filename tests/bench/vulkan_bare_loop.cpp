// What the Device costs on vulkan: the same 256 blended, textured slices drawn through it and by a bare loop of Vulkan
// calls. Compare Slices/device with Slices/bare; the image is small, so that the calls weigh most.
#include <benchmark/benchmark.h>

#include "backends/backend.h"
#include "backends/vulkan/commands.h"
#include "backends/vulkan/descriptors.h"
#include "backends/vulkan/transfer.h"
#include "programs/bench_slices_frag.h"
#include "programs/bench_slices_vert.h"

namespace volumark {
namespace {

constexpr int kSlices = 256, kVolume = 64, kImage = 64;

std::vector<float> slices() {
  constexpr float kCorners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
  std::vector<float> out;
  for (int i = 0; i < kSlices; ++i) {
    const float z = (static_cast<float>(i) + 0.5f) / kSlices;
    for (const auto& corner : kCorners) out.insert(out.end(), {corner[0], corner[1], z, 1});
  }
  return out;
}

const std::vector<float>& voxels() {
  static const std::vector<float> values(size_t{kVolume} * kVolume * kVolume, 0.5f);
  return values;
}

TextureDesc source_desc() {
  return {.label = "volume",
          .dimension = 3,
          .format = Format::R32F,
          .width = kVolume,
          .height = kVolume,
          .depth = kVolume,
          .data = bytes_of(voxels())};
}
TextureDesc target_desc() {
  TextureDesc desc;
  desc.label = "target";
  desc.width = desc.height = kImage;
  desc.target = true;
  return desc;
}

ProgramDesc program_desc() {
  ProgramDesc desc;
  desc.label = "slices";
  desc.stages = {&programs::bench_slices_vert, &programs::bench_slices_frag};
  desc.bindings = {{0, BindingKind::Sampled, 3}};
  return desc;
}
PipelineDesc pipeline_desc() {
  PipelineDesc desc;
  desc.label = "slices";
  desc.vertex_layouts = {{.stride = 16, .attributes = {{0, 4, 0}}}};
  desc.blend = Blend::Over;
  return desc;
}

void device_slices(benchmark::State& state) {
  Device device(make_vulkan_backend({}));
  const std::vector<float> corners = slices();
  const Texture source = device.create_texture(source_desc());
  const Buffer buffer =
      device.create_buffer({.label = "slices", .size = corners.size() * 4, .data = bytes_of(corners)});
  PipelineDesc desc = pipeline_desc();
  desc.program = device.create_program(program_desc());
  DrawDesc draw;
  draw.pipeline = device.create_pipeline(desc);
  draw.vertex_buffers = {buffer};
  draw.bindings = {bind_sampled(0, source)};
  draw.count = 6;
  PassDesc pass;
  pass.label = "slices";
  pass.colour = device.create_texture(target_desc());
  for (auto _ : state) {
    device.begin_pass(pass);
    for (uint32_t i = 0; i < kSlices; ++i) {
      draw.first = i * 6;
      device.draw(draw);
    }
    device.end_pass();
    device.submit_and_wait();
  }
  state.SetItemsProcessed(state.iterations() * kSlices);
}

void bare_slices(benchmark::State& state) {
  using namespace vulkan;
  const Context context{DeviceOptions{}};
  Transfer transfer(context);
  const std::vector<float> corners = slices();
  GpuTexture source(context, source_desc()), target(context, target_desc());
  transfer.fill(source, bytes_of(voxels()));
  transfer.fill(target, {});
  GpuBuffer buffer(context, corners.size() * 4, GpuBuffer::Use::General, "bench", "slices");
  transfer.fill(buffer, bytes_of(corners));
  const GpuProgram program(context, program_desc());
  const GpuPipeline pipeline(context, program, pipeline_desc());
  Descriptors descriptors(context);
  const BoundResource bound{0, BindingKind::Sampled, 0, 0, 0, {}};
  const ResolvedBinding binding{&bound, nullptr, &source};
  const VkDescriptorSet set = descriptors.get(program, 0, {&binding, 1});
  Commands work(context);

  VkRenderingAttachmentInfo colour{};
  colour.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  colour.imageView = target.target_view;
  colour.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea.extent = {kImage, kImage};
  info.layerCount = info.colorAttachmentCount = 1;
  info.pColorAttachments = &colour;
  const VkViewport viewport{0, kImage, kImage, -kImage, 0, 1};
  const VkDeviceSize start = 0;
  for (auto _ : state) {
    const VkCommandBuffer commands = work.get("bench");
    const VkImageMemoryBarrier2 there = transition(target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    record_barriers(context, commands, nullptr, {&there, 1});
    context.vk.vkCmdBeginRendering(commands, &info);
    context.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    context.vk.vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    context.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline);
    context.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program.layout, 0, 1, &set, 0,
                                       nullptr);
    context.vk.vkCmdBindVertexBuffers(commands, 0, 1, &buffer.buffer, &start);
    for (uint32_t i = 0; i < kSlices; ++i) context.vk.vkCmdDraw(commands, 6, 1, i * 6, 0);
    context.vk.vkCmdEndRendering(commands);
    const VkImageMemoryBarrier2 back = transition(target, target.rest_layout);
    record_barriers(context, commands, nullptr, {&back, 1});
    work.submit_and_wait("bench");
  }
  state.SetItemsProcessed(state.iterations() * kSlices);
}

BENCHMARK(device_slices)->Name("Slices/device")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(bare_slices)->Name("Slices/bare")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace volumark
