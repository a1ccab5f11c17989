// Every hard case of `volumark verify` on one backend, with all methods: no row may fail, and none may be empty.
#include <gtest/gtest.h>

#include "harness/verify/verify.h"
#include "tests/support/backend.h"

namespace volumark {
namespace {

std::vector<const HardCase*> cases_present() {
  std::vector<const HardCase*> out;
  for (const HardCase& hard_case : hard_case_list())
    if (hard_case.needs != CaseNeeds::Absent) out.push_back(&hard_case);
  return out;
}

class HardCases : public testing::TestWithParam<const HardCase*> {};
INSTANTIATE_TEST_SUITE_P(Each, HardCases, testing::ValuesIn(cases_present()),
                         [](const auto& tested) { return std::string(tested.param->id); });

TEST_P(HardCases, Hold) {
  const HardCase& hard_case = *GetParam();
  if (hard_case.needs == CaseNeeds::Host && backend_id() != "cpu") return;  // once is enough
  VerifyOptions options;
  options.cases = {hard_case.id};
  options.backends = {backend_id()};
  if (hard_case.needs == CaseNeeds::Backends) options.backends.push_back(backend_id() == "cpu" ? "gl" : "cpu");
  options.device = device_options();
  options.require_backends = true;
  options.data = data_options_from_environment();
  const VerifyOutcome outcome = verify(options);
  int passed = 0;
  for (const HardCaseRow& row : outcome.rows) {
    passed += row.outcome == "pass";
    EXPECT_TRUE(row.outcome == "pass" || row.outcome == "not_applicable")
        << row.method << " " << row.backend << ", " << row.check << ": " << row.outcome << ", " << row.reason;
    EXPECT_TRUE(row.outcome == "pass" || !row.reason.empty()) << row.check;
  }
  EXPECT_GT(passed, 0);
  std::printf("%s\n", verify_summary(outcome).c_str());
}

}  // namespace
}  // namespace volumark
