// The text that the gl backend hands to the driver, and its refusals that need no driver.
#include "backends/gl/gl_program.h"

#include <gtest/gtest.h>

#include "backends/backend.h"

namespace volumark {
namespace {

std::string specialise(const char* text, const std::vector<SpecConstant>& constants) {
  return specialise_glsl({"test", Stage::Fragment, text, {}}, constants);
}

TEST(SpecialiseGlsl, ConstantsStandRightAfterTheVersionLine) {
  EXPECT_EQ(specialise("#version 450\nVM_SPEC(0, LIGHTS, 1)\nVM_SPEC( 1 ,MODE , 2)\n", {{"LIGHTS", 3}, {"MODE", -4}}),
            "#version 450\nconst int LIGHTS = 3;\nconst int MODE = -4;\n#line 2\n"
            "VM_SPEC(0, LIGHTS, 1)\nVM_SPEC( 1 ,MODE , 2)\n");
}

TEST(SpecialiseGlsl, AStageThatDoesNotDeclareTheConstantKeepsTheName) {
  const std::string text = specialise("#version 450\nVM_SPEC(0, MODES, 1)\nfloat MODE;\n", {{"MODE", 1}});
  EXPECT_EQ(text, "#version 450\n#line 2\nVM_SPEC(0, MODES, 1)\nfloat MODE;\n");
}

TEST(SpecialiseGlsl, SurvivesTextThatEndsInsideTheMacro) {
  EXPECT_EQ(specialise("#version 450\nVM_SPEC(", {{"A", 1}}), "#version 450\n#line 2\nVM_SPEC(");
  EXPECT_EQ(specialise("#version 450\nVM_SPEC(0,", {{"A", 1}}), "#version 450\n#line 2\nVM_SPEC(0,");
  EXPECT_EQ(specialise("", {{"A", 1}}), "#line 1\n");
}

TEST(GlBackend, RefusesAnUnknownPlatform) {
  DeviceOptions options;
  options.gl_platform = "glx";
  try {
    make_gl_backend(options);
    FAIL() << "no error";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.kind, DeviceErrorKind::BadArgument);
    EXPECT_NE(std::string(error.what()).find("glx"), std::string::npos);
  }
}

}  // namespace
}  // namespace volumark
