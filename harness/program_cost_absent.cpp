// The build without SPIRV-Tools: no figures, and that is no error.
#include <stdexcept>

#include "harness/program_cost.h"

namespace volumark {
namespace {
constexpr const char* kAbsent = "this build counts no instructions: configure with -DVM_PROGRAM_COST=ON";
}  // namespace

bool can_count_instructions() { return false; }
std::vector<uint32_t> optimised_stage(std::span<const uint32_t>, std::span<const SpecConstant>) {
  throw std::runtime_error(kAbsent);
}
std::vector<std::string> instruction_stream(std::span<const uint32_t>) { throw std::runtime_error(kAbsent); }
int64_t count_instructions(std::span<const uint32_t>) { throw std::runtime_error(kAbsent); }
std::vector<ProgramCost> program_costs(std::span<const ProgramRecord>) { return {}; }

}  // namespace volumark
