// The report's own files, compiled in.
#pragma once

#include <string>

namespace volumark::html {

// As harness/ draws signed differences: linear, white where the test is higher by this much.
inline constexpr double kDifferenceScale = 0.05;

const char* page_template();
std::string style_text();   // all style sheets
std::string script_text();  // all scripts, in the order in which they need each other

}  // namespace volumark::html
