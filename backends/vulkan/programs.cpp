#include "backends/vulkan/programs.h"

#include <array>

#include "backends/vulkan/resources.h"

namespace volumark::vulkan {
namespace {

VkShaderStageFlagBits vk_stage(Stage stage) {
  switch (stage) {
    case Stage::Vertex:
      return VK_SHADER_STAGE_VERTEX_BIT;
    case Stage::Geometry:
      return VK_SHADER_STAGE_GEOMETRY_BIT;
    case Stage::Fragment:
      return VK_SHADER_STAGE_FRAGMENT_BIT;
    case Stage::Compute:
      break;
  }
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

VkDescriptorType vk_type(BindingKind kind) {
  switch (kind) {
    case BindingKind::Uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::Storage:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::Sampled:
      return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case BindingKind::Image:
      break;
  }
  return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

VkPrimitiveTopology vk_topology(Topology topology) {
  switch (topology) {
    case Topology::Points:
      return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    case Topology::Lines:
      return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    case Topology::Triangles:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    case Topology::TriangleStrip:
      break;
  }
  return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
}

VkCompareOp vk_compare(Compare compare) {
  switch (compare) {
    case Compare::Never:
      return VK_COMPARE_OP_NEVER;
    case Compare::Less:
      return VK_COMPARE_OP_LESS;
    case Compare::Equal:
      return VK_COMPARE_OP_EQUAL;
    case Compare::LessEqual:
      return VK_COMPARE_OP_LESS_OR_EQUAL;
    case Compare::Greater:
      return VK_COMPARE_OP_GREATER;
    case Compare::NotEqual:
      return VK_COMPARE_OP_NOT_EQUAL;
    case Compare::GreaterEqual:
      return VK_COMPARE_OP_GREATER_OR_EQUAL;
    case Compare::Always:
      break;
  }
  return VK_COMPARE_OP_ALWAYS;
}

VkStencilOp vk_stencil(StencilOp op) {
  switch (op) {
    case StencilOp::Keep:
      return VK_STENCIL_OP_KEEP;
    case StencilOp::Zero:
      return VK_STENCIL_OP_ZERO;
    case StencilOp::Replace:
      return VK_STENCIL_OP_REPLACE;
    case StencilOp::IncrementClamp:
      return VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    case StencilOp::DecrementClamp:
      return VK_STENCIL_OP_DECREMENT_AND_CLAMP;
    case StencilOp::Invert:
      return VK_STENCIL_OP_INVERT;
    case StencilOp::IncrementWrap:
      return VK_STENCIL_OP_INCREMENT_AND_WRAP;
    case StencilOp::DecrementWrap:
      break;
  }
  return VK_STENCIL_OP_DECREMENT_AND_WRAP;
}

VkCullModeFlags vk_cull(Cull cull) {
  switch (cull) {
    case Cull::None:
      return VK_CULL_MODE_NONE;
    case Cull::Front:
      return VK_CULL_MODE_FRONT_BIT;
    case Cull::Back:
      break;
  }
  return VK_CULL_MODE_BACK_BIT;
}

VkFormat vk_attribute(int components) {
  constexpr std::array kFormats = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32_SFLOAT,
                                   VK_FORMAT_R32G32B32A32_SFLOAT};
  return kFormats[static_cast<size_t>(components - 1)];
}

struct Specialisation {
  std::vector<VkSpecializationMapEntry> entries;
  VkSpecializationInfo info{};
};

Specialisation specialisation_of(const std::vector<int32_t>& constants) {
  Specialisation result;
  for (uint32_t id = 0; id < constants.size(); ++id)
    result.entries.push_back({id, id * static_cast<uint32_t>(sizeof(int32_t)), sizeof(int32_t)});
  result.info = {static_cast<uint32_t>(result.entries.size()), result.entries.data(),
                 constants.size() * sizeof(int32_t), constants.data()};
  return result;
}

VkPipelineShaderStageCreateInfo stage_info(const GpuProgram::StageModule& stage,
                                           const VkSpecializationInfo* constants) {
  VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = stage.stage;
  info.module = stage.module;
  info.pName = "main";
  info.pSpecializationInfo = constants;
  return info;
}

VkStencilOpState stencil_state(const StencilFace& face, const PipelineDesc& desc) {
  return {vk_stencil(face.fail),  vk_stencil(face.pass),   vk_stencil(face.depth_fail), vk_compare(face.compare),
          desc.stencil_read_mask, desc.stencil_write_mask, desc.stencil_reference};
}

VkPipelineDepthStencilStateCreateInfo depth_stencil_state(const PipelineDesc& desc) {
  VkPipelineDepthStencilStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  info.depthTestEnable = desc.has_depth_stencil && desc.depth_test;
  info.depthWriteEnable = info.depthTestEnable && desc.depth_write;
  info.depthCompareOp = vk_compare(desc.depth_compare);
  info.stencilTestEnable = desc.has_depth_stencil && desc.stencil_test;
  info.front = stencil_state(desc.stencil_front, desc);
  info.back = stencil_state(desc.stencil_back, desc);
  return info;
}

VkPipelineColorBlendAttachmentState blend_state(const PipelineDesc& desc) {
  VkPipelineColorBlendAttachmentState state{};
  const auto set = [&](VkBlendFactor source, VkBlendFactor target) {
    state.blendEnable = VK_TRUE;
    state.srcColorBlendFactor = state.srcAlphaBlendFactor = source;
    state.dstColorBlendFactor = state.dstAlphaBlendFactor = target;
    state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_ADD;
  };
  switch (desc.blend) {
    case Blend::Opaque:
      break;
    case Blend::Over:
      set(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA);
      break;
    case Blend::Under:
      set(VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA, VK_BLEND_FACTOR_ONE);
      break;
    case Blend::Add:
      set(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE);
      break;
  }
  if (desc.colour_write)
    state.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return state;
}

struct VertexInput {
  std::vector<VkVertexInputBindingDescription> bindings;
  std::vector<VkVertexInputAttributeDescription> attributes;
};

VertexInput vertex_input(const PipelineDesc& desc) {
  VertexInput input;
  for (uint32_t i = 0; i < desc.vertex_layouts.size(); ++i) {
    const VertexLayout& layout = desc.vertex_layouts[i];
    const VkVertexInputRate rate = layout.per_instance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX;
    input.bindings.push_back({i, layout.stride, rate});
    for (const VertexAttribute& attribute : layout.attributes)
      input.attributes.push_back({attribute.location, i, vk_attribute(attribute.components), attribute.offset});
  }
  return input;
}

}  // namespace

GpuProgram::GpuProgram(const Context& context, const ProgramDesc& desc) : label(desc.label), context_(context) {
  try {
    make(desc);
  } catch (...) {
    free();
    throw;
  }
}

GpuProgram::~GpuProgram() { free(); }

void GpuProgram::make(const ProgramDesc& desc) {
  for (const SpecConstant& constant : desc.constants) constants.push_back(constant.value);
  for (const ShaderText* text : desc.stages) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = text->spirv.size_bytes();
    info.pCode = text->spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    if (text->spirv.empty())
      throw DeviceError(DeviceErrorKind::CompileFailed, "create_program", label,
                        std::string(text->name != nullptr ? text->name : "a stage") + " has no SPIR-V");
    check(context_.vk.vkCreateShaderModule(context_.device, &info, nullptr, &module), "create_program", label,
          std::string("vkCreateShaderModule of ") + text->name, DeviceErrorKind::CompileFailed);
    stages.push_back({vk_stage(text->stage), module});
  }
  make_layouts(desc);
  if (stages.front().stage == VK_SHADER_STAGE_COMPUTE_BIT) make_compute();
}

void GpuProgram::make_layouts(const ProgramDesc& desc) {
  VkShaderStageFlags used = 0;
  for (const StageModule& stage : stages) used |= stage.stage;
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const BindingDecl& decl : desc.bindings) bindings.push_back({decl.slot, vk_type(decl.kind), 1, used, nullptr});
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.bindingCount = static_cast<uint32_t>(bindings.size());
  set.pBindings = bindings.data();
  check(context_.vk.vkCreateDescriptorSetLayout(context_.device, &set, nullptr, &set_layout), "create_program", label,
        "vkCreateDescriptorSetLayout", DeviceErrorKind::CompileFailed);
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  check(context_.vk.vkCreatePipelineLayout(context_.device, &info, nullptr, &layout), "create_program", label,
        "vkCreatePipelineLayout", DeviceErrorKind::CompileFailed);
}

void GpuProgram::make_compute() {
  const Specialisation specialisation = specialisation_of(constants);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = stage_info(stages.front(), &specialisation.info);
  info.layout = layout;
  check(context_.vk.vkCreateComputePipelines(context_.device, VK_NULL_HANDLE, 1, &info, nullptr, &compute),
        "create_program", label, "vkCreateComputePipelines", DeviceErrorKind::CompileFailed);
}

void GpuProgram::free() {
  context_.vk.vkDestroyPipeline(context_.device, compute, nullptr);
  context_.vk.vkDestroyPipelineLayout(context_.device, layout, nullptr);
  context_.vk.vkDestroyDescriptorSetLayout(context_.device, set_layout, nullptr);
  for (const StageModule& stage : stages) context_.vk.vkDestroyShaderModule(context_.device, stage.module, nullptr);
}

GpuPipeline::GpuPipeline(const Context& context, const GpuProgram& program, const PipelineDesc& desc)
    : context_(context) {
  if (desc.blend != Blend::Opaque &&
      !context.format_has(vk_format(desc.colour_format), VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT))
    throw DeviceError(DeviceErrorKind::MissingCapability, "create_pipeline", desc.label,
                      std::string("the device cannot blend to ") + to_string(desc.colour_format));
  const Specialisation specialisation = specialisation_of(program.constants);
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  for (const GpuProgram::StageModule& stage : program.stages) stages.push_back(stage_info(stage, &specialisation.info));

  const VertexInput vertices = vertex_input(desc);
  VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  input.vertexBindingDescriptionCount = static_cast<uint32_t>(vertices.bindings.size());
  input.pVertexBindingDescriptions = vertices.bindings.data();
  input.vertexAttributeDescriptionCount = static_cast<uint32_t>(vertices.attributes.size());
  input.pVertexAttributeDescriptions = vertices.attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = vk_topology(desc.topology);
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = vk_cull(desc.cull);
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;  // as seen: the viewport is turned over, see begin_pass
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  const VkPipelineDepthStencilStateCreateInfo depth_stencil = depth_stencil_state(desc);
  const VkPipelineColorBlendAttachmentState attachment = blend_state(desc);
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = 1;
  blend.pAttachments = &attachment;
  constexpr std::array kDynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = static_cast<uint32_t>(kDynamic.size());
  dynamic.pDynamicStates = kDynamic.data();
  const VkFormat colour = vk_format(desc.colour_format);
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &colour;
  if (desc.has_depth_stencil)
    rendering.depthAttachmentFormat = rendering.stencilAttachmentFormat = vk_format(Format::D32FS8);

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth_stencil;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = program.layout;
  check(context.vk.vkCreateGraphicsPipelines(context.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "create_pipeline", desc.label, "vkCreateGraphicsPipelines", DeviceErrorKind::CompileFailed);
}

GpuPipeline::~GpuPipeline() { context_.vk.vkDestroyPipeline(context_.device, pipeline, nullptr); }

}  // namespace volumark::vulkan
