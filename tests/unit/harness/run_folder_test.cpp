// The folder of a run: lock, journal, what a kill leaves behind.
#include "harness/run_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include "harness/resume.h"
#include "tests/unit/harness/test_folder.h"

namespace volumark {
namespace {

Result cell(const std::string& scene, Outcome outcome = Outcome::Failed) {
  Result result;
  result.key = {"e", scene, "m", "cpu", {{"step", 0.5}}};
  result.case_version = "1";
  result.outcome = outcome;
  result.reason = "because";
  return result;
}

TEST(RunFolder, ASecondRunIsRefusedWhileTheFirstLives) {
  const TestFolder folder;
  {
    const RunFolder first(folder.path());
    try {
      const RunFolder second(folder.path());
      FAIL();
    } catch (const FolderError& error) {
      EXPECT_NE(std::string(error.what()).find("process " + std::to_string(::getpid())), std::string::npos)
          << error.what();
    }
  }
  EXPECT_NO_THROW(RunFolder(folder.path()));
}

TEST(RunFolder, AKilledProcessLosesItsLock) {
  const TestFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const RunFolder held(folder.path());
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_NO_THROW(RunFolder(folder.path()));
}

TEST(RunFolder, FinishedCellsSurviveAKillAtAnyMoment) {
  const TestFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    RunFolder held(folder.path());
    Results results;
    held.save(results, true);
    held.begin_cell(cell("one").key);
    held.end_cell(cell("one"));
    results.results.push_back(cell("one"));
    held.save(results, true);
    held.begin_cell(cell("two").key);
    held.end_cell(cell("two"));
    held.begin_cell(cell("three").key);
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  RunFolder folder_again(folder.path());
  const auto earlier = folder_again.earlier();
  ASSERT_TRUE(earlier);
  ASSERT_EQ(earlier->results.size(), 2U);
  EXPECT_EQ(earlier->results[0].key, cell("one").key);
  EXPECT_EQ(earlier->results[1].key, cell("two").key);
  ASSERT_EQ(folder_again.died_in().size(), 1U);
  EXPECT_EQ(folder_again.died_in().at(key_text(cell("three").key)), 1);
}

TEST(RunFolder, DeathsAreCountedAcrossRunsAndSaves) {
  const TestFolder folder;
  for (int run = 1; run <= 3; ++run) {
    RunFolder held(folder.path());
    held.save({}, true);
    held.begin_cell(cell("one").key);
    held.save({}, true);
    EXPECT_EQ(held.died_in().at(key_text(cell("one").key)), run);
  }
  RunFolder held(folder.path());
  held.drop_cell(cell("one").key);
  EXPECT_TRUE(held.died_in().empty());
}

TEST(RunFolder, ALineCutShortIsLeftOut) {
  const TestFolder folder;
  {
    RunFolder held(folder.path());
    held.save({}, true);
    held.end_cell(cell("one"));
    held.end_cell(cell("two"));
  }
  const std::string journal = text_of_file(folder.path() / "journal.jsonl");
  folder.write("journal.jsonl", journal.substr(0, journal.size() - 20));
  const auto earlier = RunFolder(folder.path()).earlier();
  ASSERT_EQ(earlier->results.size(), 1U);
  EXPECT_EQ(earlier->results[0].key.scene, "one");
}

TEST(RunFolder, AJournalLineReplacesTheSameCell) {
  const TestFolder folder;
  RunFolder held(folder.path());
  Results results;
  results.results = {cell("one")};
  held.save(results, true);
  Result better = cell("one", Outcome::Timeout);
  held.end_cell(better);
  const auto earlier = held.earlier();
  ASSERT_EQ(earlier->results.size(), 1U);
  EXPECT_EQ(earlier->results[0].outcome, Outcome::Timeout);
}

TEST(RunFolder, UnusableFoldersAreClearErrors) {
  EXPECT_THROW(RunFolder("/proc/nonexistent/out"), FolderError);
  const TestFolder folder;
  const auto file = folder.write("file", "x");
  EXPECT_THROW(RunFolder{file}, FolderError);
}

TEST(Resume, TheCommandGoesOnWithTheSameCells) {
  EXPECT_EQ(resume_command({"volumark", "run", "quick", "--overwrite", "--sweep", "step=4..1*0.5", "-o", "my out"}),
            "volumark run quick --sweep 'step=4..1*0.5' -o 'my out' --resume");
  EXPECT_EQ(resume_command({"volumark", "run", "quick", "--resume"}), "volumark run quick --resume");
}

}  // namespace
}  // namespace volumark
