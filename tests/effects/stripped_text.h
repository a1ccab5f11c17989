// A program as a build makes it whose GLSL has never heard of some effects: VM_WITHOUT_NAME is defined in front of its
// text. For tests and benchmarks of what effects cost where they are not called for.
#pragma once

#include <string>
#include <vector>

#include "backends/types.h"

namespace volumark {

// The text with the defines behind its #version line.
std::string glsl_without(const ShaderText& text, const std::vector<std::string>& effects);

// Its SPIR-V, by glslangValidator. Throws std::runtime_error where that fails.
std::vector<uint32_t> spirv_without(const ShaderText& text, const std::vector<std::string>& effects);

}  // namespace volumark
