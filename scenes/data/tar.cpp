#include "scenes/data/tar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "scenes/errors.h"
#include "scenes/nearest.h"

namespace volumark {
namespace {

constexpr size_t kBlock = 512;
constexpr size_t kChecksumAt = 148, kChecksumLength = 8;

// A block of 512 bytes; its fields: POSIX.1-1988, ustar.
class Header {
 public:
  explicit Header(const std::vector<std::byte>& bytes) { std::memcpy(bytes_.data(), bytes.data(), kBlock); }

  bool is_end() const {
    return std::all_of(bytes_.begin(), bytes_.end(), [](char c) { return c == 0; });
  }
  std::string name() const {
    const std::string prefix = std::string_view(bytes_.data() + 257, 6) == std::string_view("ustar\0", 6)
                                   ? text(345, 155)
                                   : "";  // GNU tar keeps other things there
    return prefix.empty() ? text(0, 100) : prefix + "/" + text(0, 100);
  }
  bool is_regular() const { return bytes_[156] == '0' || bytes_[156] == 0; }
  std::optional<size_t> size() const { return octal(124, 12); }
  // The sum of all bytes, those of the checksum itself taken as blanks.
  bool checksum_fits() const {
    size_t sum = 0;
    for (size_t i = 0; i < kBlock; ++i) {
      const bool own = i >= kChecksumAt && i < kChecksumAt + kChecksumLength;
      sum += own ? size_t{' '} : static_cast<unsigned char>(bytes_[i]);
    }
    return octal(kChecksumAt, kChecksumLength) == sum;
  }

 private:
  std::string text(size_t at, size_t length) const {
    const char* const begin = bytes_.data() + at;
    return {begin, std::find(begin, begin + length, '\0')};
  }
  // Nothing where it is no octal number, as the sizes from 8 GiB that GNU tar writes in another way.
  std::optional<size_t> octal(size_t at, size_t length) const {
    size_t value = 0, digits = 0;
    for (const char c : text(at, length)) {
      if (c == ' ' && digits == 0) continue;
      if (c == ' ') break;
      if (c < '0' || c > '7') return std::nullopt;
      value = value * 8 + static_cast<size_t>(c - '0');
      ++digits;
    }
    return digits > 0 ? std::optional(value) : std::nullopt;
  }
  std::array<char, kBlock> bytes_{};
};

}  // namespace

void enter_tar_member(ByteSource& source, const std::string& member, const std::string& what) {
  std::vector<std::string> names;
  for (;;) {
    const std::vector<std::byte> block = source.read_up_to(kBlock);
    if (block.size() < kBlock || Header(block).is_end()) break;
    const Header header(block);
    const std::optional<size_t> size = header.size();
    if (!header.checksum_fits() || !size) {
      throw DataError(fmt::format("{}: not a tar archive, or damaged, after {} files", what, names.size()));
    }
    if (header.is_regular() && header.name() == member) return source.limit(*size);
    if (header.is_regular()) names.push_back(header.name());
    source.skip((*size + kBlock - 1) / kBlock * kBlock);
  }
  if (names.empty()) throw DataError(fmt::format("{}: a tar archive without files", what));
  throw DataError(fmt::format("{}: the archive has no file \"{}\"{}; it has: {}", what, member,
                              did_you_mean(member, names), fmt::join(names, ", ")));
}

}  // namespace volumark
