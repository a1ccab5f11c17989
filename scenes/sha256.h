// SHA-256 (FIPS 180-4) of bytes in memory: how data files are recognised and scenes are told apart.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace volumark {

// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::span<const std::byte> bytes);
std::string sha256_hex(std::string_view text);

}  // namespace volumark
