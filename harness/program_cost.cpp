#include "harness/program_cost.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <set>
#include <spirv-tools/optimizer.hpp>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

namespace volumark {
namespace {

constexpr spv_target_env kTarget = SPV_ENV_VULKAN_1_3;
constexpr uint32_t kBuiltIn = 11, kLocation = 30, kBinding = 33, kDescriptorSet = 34;  // SPIR-V 1.6, 3.20 Decoration

const char* name_of(Stage stage) {
  constexpr const char* kNames[] = {"vertex", "geometry", "fragment", "compute"};
  return kNames[static_cast<size_t>(stage)];
}

// Structure that no machine runs: it is left out of the count.
bool counts(std::string_view opcode) {
  static const std::set<std::string_view> kStructure = {"Function",    "FunctionParameter",
                                                        "FunctionEnd", "Label",
                                                        "Variable",    "SelectionMerge",
                                                        "LoopMerge",   "Phi",
                                                        "Line",        "NoLine",
                                                        "Nop"};
  return !kStructure.contains(opcode);
}

struct ParsedOperand {
  spv_operand_type_t type;
  std::vector<uint32_t> words;
};
struct ParsedInstruction {
  std::string opcode;
  uint32_t type = 0, result = 0;  // ids; 0: none
  std::vector<ParsedOperand> operands;
  bool in_body = false;
};

struct Parser {
  std::vector<ParsedInstruction> instructions;
  bool in_function = false;

  static spv_result_t add(void* self, const spv_parsed_instruction_t* parsed) {
    auto& parser = *static_cast<Parser*>(self);
    ParsedInstruction out;
    out.opcode = spvOpcodeString(parsed->opcode);
    out.type = parsed->type_id;
    out.result = parsed->result_id;
    if (out.opcode == "Function") parser.in_function = true;
    out.in_body = parser.in_function;
    if (out.opcode == "FunctionEnd") parser.in_function = false;
    for (const spv_parsed_operand_t& operand : std::span(parsed->operands, parsed->num_operands))
      out.operands.push_back(
          {operand.type, {parsed->words + operand.offset, parsed->words + operand.offset + operand.num_words}});
    parser.instructions.push_back(std::move(out));
    return SPV_SUCCESS;
  }
};

std::vector<ParsedInstruction> parse(std::span<const uint32_t> spirv) {
  const spvtools::Context context(kTarget);
  Parser parser;
  spv_diagnostic diagnostic = nullptr;
  const spv_result_t result =
      spvBinaryParse(context.CContext(), &parser, spirv.data(), spirv.size(), nullptr, &Parser::add, &diagnostic);
  const std::string message = diagnostic != nullptr ? diagnostic->error : "";
  spvDiagnosticDestroy(diagnostic);
  if (result != SPV_SUCCESS) throw std::runtime_error("SPIR-V cannot be read: " + message);
  return std::move(parser.instructions);
}

bool is_id(spv_operand_type_t type) {
  return type == SPV_OPERAND_TYPE_ID || type == SPV_OPERAND_TYPE_TYPE_ID || type == SPV_OPERAND_TYPE_RESULT_ID ||
         type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID || type == SPV_OPERAND_TYPE_SCOPE_ID;
}

// Writes instructions without depending on how the ids of a module were handed out.
class StreamWriter {
 public:
  explicit StreamWriter(const std::vector<ParsedInstruction>& instructions) {
    for (const ParsedInstruction& instruction : instructions) {
      if (instruction.opcode == "Decorate") note_decoration(instruction);
      if (!instruction.in_body && instruction.result != 0) globals_[instruction.result] = &instruction;
    }
  }

  std::string line(const ParsedInstruction& instruction) {
    std::string out = instruction.opcode;
    for (const ParsedOperand& operand : instruction.operands) out += " " + text_of(operand);
    return out;
  }

 private:
  // Where a resource or an interface variable is bound: it stands for the name.
  void note_decoration(const ParsedInstruction& instruction) {
    const uint32_t kind = instruction.operands.at(1).words.at(0);
    if (kind != kBuiltIn && kind != kLocation && kind != kBinding && kind != kDescriptorSet) return;
    decorations_[instruction.operands.at(0).words.at(0)] +=
        fmt::format(" {}={}", kind, instruction.operands.at(2).words.at(0));
  }

  std::string text_of(const ParsedOperand& operand) {
    if (is_id(operand.type)) return id_text(operand.words.at(0));
    std::string out;
    for (const uint32_t word : operand.words) out += fmt::format("{}{:x}", out.empty() ? "" : ".", word);
    return out;
  }

  std::string id_text(uint32_t id) {
    const auto global = globals_.find(id);
    if (global == globals_.end()) {
      const auto number = locals_.try_emplace(id, locals_.size()).first->second;
      return fmt::format("%{}", number);
    }
    const auto known = texts_.find(id);
    if (known != texts_.end()) return known->second;
    const ParsedInstruction& definition = *global->second;
    std::string out = definition.opcode;
    if (out != "TypeStruct")
      for (const ParsedOperand& operand : definition.operands)
        if (operand.type != SPV_OPERAND_TYPE_RESULT_ID) out += " " + text_of(operand);
    const auto decorated = decorations_.find(id);
    if (decorated != decorations_.end()) out += decorated->second;
    return texts_[id] = "(" + out + ")";
  }

  std::unordered_map<uint32_t, const ParsedInstruction*> globals_;
  std::unordered_map<uint32_t, std::string> decorations_, texts_;
  std::unordered_map<uint32_t, size_t> locals_;
};

}  // namespace

bool can_count_instructions() { return true; }

std::vector<uint32_t> optimised_stage(std::span<const uint32_t> spirv, std::span<const SpecConstant> constants) {
  spvtools::Optimizer optimizer(kTarget);
  std::string messages;
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
    if (level <= SPV_MSG_ERROR) messages += std::string(messages.empty() ? "" : "; ") + message;
  });
  std::unordered_map<uint32_t, std::vector<uint32_t>> values;
  for (size_t i = 0; i < constants.size(); ++i)
    values[static_cast<uint32_t>(i)] = {static_cast<uint32_t>(constants[i].value)};
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass())
      .RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateUnifyConstantPass());
  // Twice: what the first round leaves behind of a branch that is never taken (blocks, stores, loops of no turn) shows
  // only when the branch is gone.
  optimizer.RegisterPerformancePasses().RegisterPerformancePasses();
  optimizer.RegisterPass(spvtools::CreateEliminateDeadConstantPass()).RegisterPass(spvtools::CreateCompactIdsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // glslangValidator made it
  std::vector<uint32_t> out;
  if (!optimizer.Run(spirv.data(), spirv.size(), &out, options))
    throw std::runtime_error("SPIRV-Tools cannot optimise the program: " + messages);
  return out;
}

std::vector<std::string> instruction_stream(std::span<const uint32_t> spirv) {
  const std::vector<ParsedInstruction> instructions = parse(spirv);
  StreamWriter writer(instructions);
  std::vector<std::string> out;
  for (const ParsedInstruction& instruction : instructions)
    if (instruction.in_body) out.push_back(writer.line(instruction));
  return out;
}

int64_t count_instructions(std::span<const uint32_t> spirv) {
  int64_t count = 0;
  for (const ParsedInstruction& instruction : parse(spirv))
    if (instruction.in_body && counts(instruction.opcode)) ++count;
  return count;
}

std::vector<ProgramCost> program_costs(std::span<const ProgramRecord> programs) {
  static std::mutex mutex;
  static std::map<std::pair<const ShaderText*, std::vector<int32_t>>, int64_t> known;
  const std::lock_guard lock(mutex);
  std::vector<ProgramCost> out;
  for (const ProgramRecord& program : programs) {
    std::vector<int32_t> values;
    for (const SpecConstant& constant : program.constants) values.push_back(constant.value);
    for (const ShaderText* stage : program.stages) {
      const auto [entry, fresh] = known.try_emplace({stage, values}, 0);
      if (fresh) entry->second = count_instructions(optimised_stage(stage->spirv, program.constants));
      out.push_back({program.label, name_of(stage->stage), entry->second});
    }
  }
  return out;
}

}  // namespace volumark
