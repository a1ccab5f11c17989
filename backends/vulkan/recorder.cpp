#include "backends/vulkan/recorder.h"

#include <algorithm>
#include <cstring>

namespace volumark::vulkan {

Recorder::Recorder(const Context& context)
    : context_(context), commands_(context), descriptors_(context), zones_(context) {}

void Recorder::order(VkCommandBuffer commands, std::span<const Pass> next_pass) {
  const auto kept = [&](const GpuTexture* texture) {
    return !next_pass.empty() && (texture == next_pass[0].colour || texture == next_pass[0].depth_stencil);
  };
  for (GpuTexture* texture : attached_)
    if (!kept(texture)) image_barriers_.push_back(transition(*texture, texture->rest_layout));
  std::erase_if(attached_, [&](const GpuTexture* texture) { return !kept(texture); });
  const VkMemoryBarrier2 memory = full_barrier();
  record_barriers(context_, commands, unordered_ ? &memory : nullptr, image_barriers_);
  image_barriers_.clear();
  unordered_ = false;
}

void Recorder::attach(GpuTexture& texture, VkImageLayout layout, bool cleared) {
  texture.used_in = serial_;
  if (texture.layout == layout) return;
  if (cleared) texture.layout = VK_IMAGE_LAYOUT_UNDEFINED;  // nobody reads the old contents
  image_barriers_.push_back(transition(texture, layout));
  attached_.push_back(&texture);
}

void Recorder::begin_pass(const Pass& pass) {
  const VkCommandBuffer commands = commands_.get("begin_pass");
  const PassDesc& desc = *pass.desc;
  attach(*pass.colour, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, desc.clear_colour);
  if (pass.depth_stencil != nullptr)
    attach(*pass.depth_stencil, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, desc.clear_depth_stencil);
  order(commands, {&pass, 1});

  const auto load = [](bool clear) { return clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD; };
  VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  colour.imageView = pass.colour->target_view;
  colour.imageLayout = pass.colour->layout;
  colour.loadOp = load(desc.clear_colour);
  colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  std::copy(desc.colour_value.begin(), desc.colour_value.end(), colour.clearValue.color.float32);
  VkRenderingAttachmentInfo depth_stencil{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = {pass.colour->extent.width, pass.colour->extent.height};
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &colour;
  if (pass.depth_stencil != nullptr) {
    depth_stencil.imageView = pass.depth_stencil->target_view;
    depth_stencil.imageLayout = pass.depth_stencil->layout;
    depth_stencil.loadOp = load(desc.clear_depth_stencil);
    depth_stencil.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth_stencil.clearValue.depthStencil = {desc.depth_value, desc.stencil_value};
    info.pDepthAttachment = info.pStencilAttachment = &depth_stencil;
  }
  context_.vk.vkCmdBeginRendering(commands, &info);
  // Turned over: NDC +y is up, and row 0 is the top row.
  const auto width = static_cast<float>(info.renderArea.extent.width);
  const auto height = static_cast<float>(info.renderArea.extent.height);
  const VkViewport viewport{0, height, width, -height, 0, 1};
  context_.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
  context_.vk.vkCmdSetScissor(commands, 0, 1, &info.renderArea);
}

void Recorder::use(std::span<const ResolvedBinding> bindings) {
  for (const ResolvedBinding& binding : bindings)
    (binding.buffer != nullptr ? binding.buffer->used_in : binding.texture->used_in) = serial_;
}

void Recorder::bind(VkPipelineBindPoint point, VkPipeline pipeline, const GpuProgram& program, uint32_t program_id,
                    std::span<const ResolvedBinding> bindings) {
  const VkCommandBuffer commands = commands_.get("draw");
  if (bound_.pipeline != pipeline) {
    context_.vk.vkCmdBindPipeline(commands, point, pipeline);
    bound_.pipeline = pipeline;
  }
  if (bindings.empty()) return;
  const auto equal = [](const ResolvedBinding& a, const BoundResource& b) {
    return same_bindings({a.bound, 1}, {&b, 1});
  };
  if (bound_.set != VK_NULL_HANDLE && bound_.program_id == program_id &&
      std::equal(bindings.begin(), bindings.end(), bound_.bindings.begin(), bound_.bindings.end(), equal))
    return;
  use(bindings);
  bound_.set = descriptors_.get(program, program_id, bindings);
  bound_.program_id = program_id;
  bound_.bindings.clear();
  for (const ResolvedBinding& binding : bindings) bound_.bindings.push_back(*binding.bound);
  context_.vk.vkCmdBindDescriptorSets(commands, point, program.layout, 0, 1, &bound_.set, 0, nullptr);
}

void Recorder::draw(const Draw& draw) {
  if (draw.count == 0 || draw.instances == 0) return;
  bind(VK_PIPELINE_BIND_POINT_GRAPHICS, draw.pipeline, *draw.program, draw.program_id, draw.bindings);
  const VkCommandBuffer commands = commands_.get("draw");
  constexpr VkDeviceSize kStart = 0;
  for (uint32_t i = 0; i < draw.vertex_buffers.size(); ++i) {
    GpuBuffer& buffer = *draw.vertex_buffers[i];
    if (bound_.vertices[i] == buffer.buffer) continue;
    bound_.vertices[i] = buffer.buffer;
    buffer.used_in = serial_;
    context_.vk.vkCmdBindVertexBuffers(commands, i, 1, &buffer.buffer, &kStart);
  }
  if (draw.index_buffer == nullptr) {
    context_.vk.vkCmdDraw(commands, draw.count, draw.instances, draw.first, 0);
    return;
  }
  if (bound_.indices != draw.index_buffer->buffer) {
    bound_.indices = draw.index_buffer->buffer;
    draw.index_buffer->used_in = serial_;
    context_.vk.vkCmdBindIndexBuffer(commands, bound_.indices, 0, VK_INDEX_TYPE_UINT32);
  }
  context_.vk.vkCmdDrawIndexed(commands, draw.count, draw.instances, draw.first, 0, 0);
}

void Recorder::end_pass() {
  context_.vk.vkCmdEndRendering(commands_.get("end_pass"));
  unordered_ = true;
}

void Recorder::dispatch(const GpuProgram& program, uint32_t program_id, std::span<const ResolvedBinding> bindings,
                        std::array<uint32_t, 3> groups) {
  const auto& most = context_.properties.limits.maxComputeWorkGroupCount;
  for (size_t i = 0; i < 3; ++i)
    if (groups[i] > most[i])
      throw DeviceError(DeviceErrorKind::LimitExceeded, "dispatch", program.label,
                        std::to_string(groups[i]) + " groups; the device takes " + std::to_string(most[i]));
  const VkCommandBuffer commands = commands_.get("dispatch");
  order(commands, {});
  bind(VK_PIPELINE_BIND_POINT_COMPUTE, program.compute, program, program_id, bindings);
  context_.vk.vkCmdDispatch(commands, groups[0], groups[1], groups[2]);
  bound_ = {};  // the two bind points have states of their own; dispatches are few
  unordered_ = true;
}

VkBuffer Recorder::stage(std::span<const std::byte> data, size_t& offset) {
  if (chunks_.empty() || chunk_used_ + data.size() > chunks_.back()->size) {
    chunks_.push_back(std::make_unique<GpuBuffer>(context_, std::max(kChunkBytes, data.size()),
                                                  GpuBuffer::Use::Transfer, "update_buffer", "staging"));
    chunk_used_ = 0;
  }
  offset = chunk_used_;
  chunk_used_ += data.size();
  std::memcpy(chunks_.back()->mapped + offset, data.data(), data.size());
  return chunks_.back()->buffer;
}

void Recorder::update(GpuBuffer& buffer, size_t offset, std::span<const std::byte> data) {
  if (data.empty()) return;
  if (buffer.mapped != nullptr && !refers_to(buffer)) {
    std::memcpy(buffer.mapped + offset, data.data(), data.size());
    return;
  }
  VkBufferCopy copy{0, offset, data.size()};
  const VkBuffer from = stage(data, copy.srcOffset);
  const VkCommandBuffer commands = commands_.get("update_buffer");
  buffer.used_in = serial_;
  order(commands, {});
  context_.vk.vkCmdCopyBuffer(commands, from, buffer.buffer, 1, &copy);
  unordered_ = true;
}

void Recorder::begin_zone(const std::string& name) { zones_.begin(commands_.get("begin_zone"), name); }

void Recorder::end_zone() { zones_.end(commands_.get("end_zone")); }

void Recorder::flush(std::string_view call) {
  if (!commands_.recording()) return;
  const VkCommandBuffer commands = commands_.get(call);
  order(commands, {});
  VkMemoryBarrier2 to_host = full_barrier();
  to_host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  to_host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  record_barriers(context_, commands, &to_host, {});
  bound_ = {};
  commands_.submit_and_wait(call);
  ++serial_;
  descriptors_.recycle();
  // One chunk is kept: frames with few updates shall not allocate each time.
  if (chunks_.size() > 1 || (!chunks_.empty() && chunks_.back()->size > kChunkBytes)) chunks_.clear();
  chunk_used_ = 0;
}

void Recorder::forget_ids() {
  descriptors_.forget();
  bound_ = {};
}

}  // namespace volumark::vulkan
