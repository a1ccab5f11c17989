#include "scenes/data/tar.h"

#include <fmt/format.h>

#include "helpers.h"
#include "scenes/data/raw.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using test::Bytes;
using test::bytes_of;
using test::operator+;
using testing::AllOf;
using testing::HasSubstr;

// One file of an archive: a header of 512 bytes (POSIX ustar) and the content, filled up to whole blocks.
Bytes file(const std::string& name, const std::string& content, char type = '0', const std::string& prefix = "") {
  std::string header(512, '\0');
  const auto put = [&](size_t at, const std::string& text) { header.replace(at, text.size(), text); };
  put(0, name);
  put(124, fmt::format("{:011o}", content.size()));
  put(148, std::string(8, ' '));
  header[156] = type;
  put(257, std::string("ustar\0"
                       "00",
                       8));
  put(345, prefix);
  size_t sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  put(148, fmt::format("{:06o}", sum) + std::string("\0 ", 2));
  std::string body = content;
  body.resize((body.size() + 511) / 512 * 512);
  return bytes_of(header + body);
}

const Bytes kEnd(1024);

RawLayout layout(const std::string& member, bool gzip) {
  RawLayout out{{4, 1, 1}, VoxelType::U8, false, 0, gzip};
  out.member = member;
  return out;
}

Volume read(const Bytes& bytes, const RawLayout& raw) { return read_raw(bytes, raw, NonFinite::Refuse, "t.tar"); }

TEST(Tar, ReadsTheMemberThatIsNamed) {
  const Bytes archive = file("dir/", "", '5') + file("dir/a.txt", std::string(700, 'x')) +
                        file("m.dat", "abcd", '0', "dir") + file("z", "later") + kEnd;
  for (const bool gzip : {false, true}) {
    const Volume v = read(gzip ? test::gzipped(archive) : archive, layout("dir/m.dat", gzip));
    EXPECT_EQ(v.at(0, 0, 0), 'a');
    EXPECT_EQ(v.at(3, 0, 0), 'd');
  }
}

TEST(Tar, AMemberOfAnotherSizeSaysExpectedAndFound) {
  for (const bool gzip : {false, true})
    for (const char* content : {"abc", "abcde"}) {
      const Bytes archive = file("m", content) + kEnd;
      EXPECT_THAT(
          test::message_of<DataError>([&] { read(gzip ? test::gzipped(archive) : archive, layout("m", gzip)); }),
          AllOf(HasSubstr("t.tar"), HasSubstr("expected 4 bytes, found")));
    }
}

TEST(Tar, AHeaderIsSkippedWithinTheMember) {
  RawLayout raw = layout("m", false);
  raw.header_bytes = 2;
  EXPECT_EQ(read(file("m", "..abcd") + kEnd, raw).at(0, 0, 0), 'a');
  raw.header_bytes = 7;
  EXPECT_THAT(test::message_of<DataError>([&] { read(file("m", "..abcd") + kEnd, raw); }),
              HasSubstr("expected 7 bytes before the samples, found 6"));
}

TEST(Tar, AMissingMemberNamesThoseThatAreThere) {
  const Bytes archive = file("matrix.dat", "abcd") + file("other", "x") + kEnd;
  EXPECT_THAT(test::message_of<DataError>([&] { read(archive, layout("matrix.da", false)); }),
              AllOf(HasSubstr("no file \"matrix.da\""), HasSubstr("matrix.dat"), HasSubstr("other")));
  EXPECT_THAT(test::message_of<DataError>([&] { read(kEnd, layout("m", false)); }), HasSubstr("without files"));
}

TEST(Tar, DamagedAndTruncatedArchivesAreErrors) {
  Bytes archive = file("first", "ab") + file("m", "abcd") + kEnd;
  archive[1024 + 3] = std::byte{'!'};  // the second header
  EXPECT_THAT(test::message_of<DataError>([&] { read(archive, layout("m", false)); }),
              HasSubstr("not a tar archive, or damaged, after 1 files"));
  EXPECT_THAT(test::message_of<DataError>([&] { read(bytes_of(std::string(600, 'x')), layout("m", false)); }),
              HasSubstr("not a tar archive"));
  const Bytes whole = file("m", "abcd");
  EXPECT_THAT(test::message_of<DataError>([&] { read(Bytes(whole.begin(), whole.begin() + 514), layout("m", false)); }),
              HasSubstr("expected 4 bytes, found 2"));
}

}  // namespace
}  // namespace volumark
