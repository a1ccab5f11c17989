// Several runs as one: what is kept, what is refused, and where their pictures lie.
#include "reports/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/reports/sample_results.h"

namespace volumark {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Merge : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("merge-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const Results& results) {
    fs::create_directories(folder_ / name);
    write_results(results, folder_ / name / "results.json");
    return folder_ / name;
  }

  fs::path folder_;
};

// A run that came to its end.
Results whole() {
  Results out = sample_results();
  out.run.finished_at = "2026-01-01T11:00:00Z";
  out.run.interrupted = false;
  return out;
}

// A run of another experiment, with a hard case whose picture climbs out of its folder.
Results second() {
  Results out = whole();
  for (Result& cell : out.results) cell.key.experiment = "other";
  out.experiments.resize(1);
  out.experiments[0].name = "other";
  HardCaseRow row;
  row.id = "slab";
  row.outcome = "pass";
  row.picture = ImageFile{"../escape.exr", "", 1, 1, "linear", "images/slab.png"};
  out.hard_cases = {row};
  return out;
}

TEST_F(Merge, OneRunStaysAsItIs) {
  const Results given = whole();
  const std::vector<fs::path> paths = {write("one", given)};
  const MergedResults merged = merge_results(paths);
  EXPECT_EQ(merged.folder, folder_ / "one");
  EXPECT_EQ(merged.results.results.size(), given.results.size());
  EXPECT_TRUE(merged.notes.empty());
}

TEST_F(Merge, CellsOfBothAreKeptAndDescribedOnce) {
  const Results first = whole();
  const std::vector<fs::path> paths = {write("one", first), write("two", second())};
  const MergedResults merged = merge_results(paths);
  EXPECT_EQ(merged.folder, folder_);
  EXPECT_EQ(merged.results.results.size(), 2 * first.results.size());
  EXPECT_EQ(merged.results.scenes.size(), first.scenes.size());
  EXPECT_EQ(merged.results.backends.size(), first.backends.size());
  EXPECT_EQ(merged.results.experiments.size(), first.experiments.size() + 1);
  ASSERT_EQ(merged.results.hard_cases.size(), 1U);
  EXPECT_EQ(merged.results.run.id, first.run.id);
}

TEST_F(Merge, PicturesAreFoundBelowTheCommonFolder) {
  const std::vector<fs::path> paths = {write("one", whole()), write("two", second()) / "results.json"};
  const MergedResults merged = merge_results(paths);
  const ImageFile& image = *merged.results.hard_cases[0].picture;
  EXPECT_EQ(image.preview, "two/images/slab.png");
  EXPECT_EQ(image.path, "two/../escape.exr") << "never resolved: the report refuses it still";
}

TEST_F(Merge, TheSameCellTwiceIsRefused) {
  const std::vector<fs::path> paths = {write("one", whole()), write("two", whole())};
  try {
    merge_results(paths);
    FAIL() << "accepted";
  } catch (const ResultsError& error) {
    EXPECT_THAT(error.what(), HasSubstr("is in another of these results too"));
  }
}

TEST_F(Merge, DifferencesAreSaid) {
  Results other = second();
  other.git.sha = "another";
  other.machine.cpu = "Another CPU";
  const std::vector<fs::path> paths = {write("one", whole()), write("two", other)};
  const MergedResults merged = merge_results(paths);
  ASSERT_FALSE(merged.notes.empty());
  EXPECT_THAT(merged.notes[0], HasSubstr("another commit another"));
  EXPECT_THAT(merged.notes[0], HasSubstr("machine Another CPU"));
}

TEST_F(Merge, SoftwareAndHardwareUnderOneNameAreRefused) {
  Results other = second();
  ASSERT_FALSE(other.backends.empty());
  other.backends[0].software = !other.backends[0].software;
  const std::vector<fs::path> paths = {write("one", whole()), write("two", other)};
  EXPECT_THROW(merge_results(paths), ResultsError);
}

TEST_F(Merge, AnotherSceneOfTheSameNameAndAFirstRunThatDidNotFinishAreSaid) {
  Results first = whole(), other = second();
  first.run.finished_at.clear();
  other.scenes[0].hash = "another";
  const std::vector<fs::path> paths = {write("one", first), write("two", other)};
  const MergedResults merged = merge_results(paths);
  ASSERT_EQ(merged.notes.size(), 2U);
  EXPECT_THAT(merged.notes[0], HasSubstr("one did not finish"));
  EXPECT_THAT(merged.notes[1], HasSubstr("scene " + other.scenes[0].name));
}

TEST_F(Merge, HardCasesAreThoseOfTheFirstThatHasThem) {
  Results third = second();
  for (Result& cell : third.results) cell.key.experiment = "third";
  third.hard_cases.push_back(third.hard_cases[0]);
  const std::vector<fs::path> paths = {write("two", second()), write("three", third)};
  const MergedResults merged = merge_results(paths);
  EXPECT_EQ(merged.results.hard_cases.size(), 1U);
  EXPECT_THAT(merged.notes, ::testing::Contains(HasSubstr("hard cases of")));
}

TEST_F(Merge, NothingIsRefused) { EXPECT_THROW(merge_results({}), ResultsError); }

}  // namespace
}  // namespace volumark
