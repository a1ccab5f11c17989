// Shader modules with their layouts, and the pipelines made from them.
#pragma once

#include "backends/vulkan/context.h"

namespace volumark::vulkan {

class GpuProgram {
 public:
  GpuProgram(const Context& context, const ProgramDesc& desc);
  ~GpuProgram();
  GpuProgram(const GpuProgram&) = delete;

  // Holds for as long as the program does. `constants` as VkSpecializationInfo wants them: id = position.
  struct StageModule {
    VkShaderStageFlagBits stage;
    VkShaderModule module;
  };
  std::vector<StageModule> stages;
  std::vector<int32_t> constants;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline compute = VK_NULL_HANDLE;  // of a compute program
  std::string label;

 private:
  void make(const ProgramDesc& desc);
  void make_layouts(const ProgramDesc& desc);
  void make_compute();
  void free();
  const Context& context_;
};

class GpuPipeline {
 public:
  GpuPipeline(const Context& context, const GpuProgram& program, const PipelineDesc& desc);
  ~GpuPipeline();
  GpuPipeline(const GpuPipeline&) = delete;

  VkPipeline pipeline = VK_NULL_HANDLE;

 private:
  const Context& context_;
};

}  // namespace volumark::vulkan
