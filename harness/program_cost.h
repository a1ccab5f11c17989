// How many instructions a program has as it runs: its SPIR-V with the specialisation constants set, frozen and folded,
// then optimised by SPIRV-Tools. What counts is every instruction in a function body except what is only structure
// (labels, merges, phis, variables, function begin and end). Static: a loop's body counts once, however often it runs.
// The GLSL text is one for gl and vulkan, so are the figures; the cpu twin is other code.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "backends/types.h"
#include "reports/results.h"

namespace volumark {

// False in a build without SPIRV-Tools (VM_PROGRAM_COST=OFF): program_costs() is then empty, the others throw.
bool can_count_instructions();

// SPIR-V of one stage with `constants` (by position, as in ProgramDesc) set, after the optimiser. Throws
// std::runtime_error where SPIRV-Tools refuses the module, with its message.
std::vector<uint32_t> optimised_stage(std::span<const uint32_t> spirv, std::span<const SpecConstant> constants);

// One line an instruction of the function bodies, structure included, with ids numbered in the order in which they are
// met; types, constants and resources are written out, without names, and structs as "struct". Two modules with the
// same stream run the same instructions. Throws std::runtime_error for what is no SPIR-V.
std::vector<std::string> instruction_stream(std::span<const uint32_t> spirv);

// Instructions of the function bodies that count. Throws std::runtime_error for what is no SPIR-V.
int64_t count_instructions(std::span<const uint32_t> spirv);

// Of every stage of each program, in their order. Figures are remembered: a program costs its optimising once a
// process.
std::vector<ProgramCost> program_costs(std::span<const ProgramRecord> programs);

}  // namespace volumark
