// Numbers and text as the report shows them: three significant digits, milliseconds, and everything that comes from a
// file escaped.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reports/results.h"

namespace volumark::html {

// For text and for attributes in double quotes.
std::string escape(std::string_view text);

// JSON that may stand inside <script>: no '<' is left.
std::string json_for_script(std::string json);

// "0.0123", "12.3", "1230"; "1.23e-5" below 1e-3, "1.23e+7" from 1e6; "n/a" for NaN, "infinite".
std::string number(double value);
std::string scientific(double value);      // "1.23e-3"; errors, so that columns can be compared
std::string milliseconds(double seconds);  // without the unit
std::string compact(double value);         // as short as it is exact to six digits: "0.25", "1e-3"
std::string power_of_ten(double value);    // one digit: "3e-4"
std::string to_text(const ParamValue& value);

}  // namespace volumark::html
