// Spelling help for error messages: the candidate closest to what was written.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace volumark {

// Empty where nothing is close (more than half of the letters differ). Distance: insertions, deletions,
// substitutions and swaps of neighbours, ignoring case.
std::string nearest_name(std::string_view written, std::span<const std::string> candidates);

// " (did you mean \"NAME\"?)" or nothing.
std::string did_you_mean(std::string_view written, std::span<const std::string> candidates);

}  // namespace volumark
