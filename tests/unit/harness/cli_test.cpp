// The command line as a user meets it: exit codes, messages, files. Runs the program itself.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/unit/harness/test_folder.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

struct Said {
  int code = -1;
  std::string text;  // stdout and stderr
};

class Cli : public testing::Test {
 protected:
  Said volumark(const std::string& arguments) const {
    const std::string command =
        fmt::format("cd '{}' && VOLUMARK_CACHE=cache '{}' {} 2>&1", folder_.path().string(), VM_VOLUMARK, arguments);
    std::FILE* pipe = ::popen(command.c_str(), "r");
    Said said;
    char buffer[4096];
    for (size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) said.text.append(buffer, n);
    const int status = ::pclose(pipe);
    said.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    return said;
  }
  void expect(const std::string& arguments, int code, const std::string& part) const {
    const Said said = volumark(arguments);
    EXPECT_EQ(said.code, code) << arguments << "\n" << said.text;
    EXPECT_NE(said.text.find(part), std::string::npos) << arguments << ": expected \"" << part << "\" in\n"
                                                       << said.text;
  }
  // Slow enough to be stopped: many cells, each with its budget to spend.
  void write_experiment(double budget) const {
    Json sweep = Json::array();
    for (int i = 0; i < 12; ++i) sweep.push_back(4 - 0.25 * i);
    const Json json = {{"name", "tiny"},
                       {"scenes", {"slab"}},
                       {"methods", {{{"method", "texture3d_slices"}, {"sweep", sweep}}}},
                       {"backends", {"null"}},
                       {"views", 1},
                       {"image_size", {16, 16}},
                       {"images", "none"},
                       {"sampling", {{"least", 2}, {"most", 100000}, {"budget", budget}, {"precision", 0}}}};
    folder_.write("tiny.json", json.dump());
  }
  size_t cells_on_disk() const {
    const auto count = [&](const char* file, const char* word) {
      const std::string text = text_of_file(folder_.path() / "out" / file);
      size_t n = 0;
      for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
      return n;
    };
    return count("results.json", "\"case_version\"") + count("journal.jsonl", "\"case_version\"");
  }
  pid_t start(const std::string& arguments) const {
    const pid_t child = ::fork();
    if (child == 0) {
      const std::string command = fmt::format("cd '{}' && VOLUMARK_CACHE=cache exec '{}' {} >/dev/null 2>&1",
                                              folder_.path().string(), VM_VOLUMARK, arguments);
      ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      std::_Exit(99);
    }
    return child;
  }
  bool wait_for_cells(size_t wanted) const {
    for (int i = 0; i < 600; ++i) {
      if (cells_on_disk() >= wanted) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  TestFolder folder_;
};

TEST_F(Cli, VersionAndHelp) {
  expect("--version", 0, "commit");
  expect("--help", 0, "Exit codes");
  for (const char* command : {"list", "render", "run", "report", "diff", "validate", "bench"})
    expect(fmt::format("{} --help", command), 0, "Example: volumark ");
}

TEST_F(Cli, UsageErrorsExitWithTwo) {
  expect("", 2, "");
  expect("paint", 2, "");
  expect("list colours", 2, "unknown kind");
  expect("list scene", 2, "did you mean \"scenes\"?");
  expect("render spere -m raycast -o a.pfm", 2, "did you mean \"sphere\"?");
  expect("render slab -m raycat -o a.pfm", 2, "did you mean \"raycast\"?");
  expect("render slab -m raycast -b cpuu -o a.pfm", 2, "did you mean \"cpu\"?");
  expect("render slab -m raycast -b cpu --set stp=1 -o a.pfm", 2, "did you mean \"step\"?");
  expect("render slab -m raycast -b cpu --set step=0 -o a.pfm", 2, "out of range");
  expect("render slab -m raycast -b cpu --set step -o a.pfm", 2, "name=value");
  expect("render slab -m raycast -b cpu --size 0x5 -o a.pfm", 2, "WIDTHxHEIGHT");
  expect("render slab -m raycast -b cpu --view 99 --size 8x8 -o a.pfm", 2, "views 0 to");
  expect("render slab -m raycast -b cpu --size 8x8 -o a.jpg", 2, ".exr, .png or .pfm");
  expect("render ./nowhere.json -m raycast -o a.pfm", 2, "nowhere.json");
  expect("--data /nonexistent render slab -m reference -o a.pfm", 2, "no such folder");
  expect("run quik", 2, "did you mean \"quick\"?");
  expect("run quick --scene spere", 2, "did you mean \"sphere\"?");
  expect("run quick --backend gpu", 2, "unknown backend");
  expect("run quick --scene slab --out /proc/nowhere", 2, "output folder");
  expect("run accuracy --sweep stp=1", 2, "did you mean \"step\"?");
  expect("run accuracy --sweep step=fine", 2, "expected a number");
  expect("run accuracy --sweep step=4..1*2", 2, "is empty");
  expect("run accuracy --sweep step=1,1", 2, "named twice");
  expect("run accuracy --sweep target_format=rgba9", 2, "unknown value");
  expect("run accuracy --sweep table_size=2..1001+1", 2, "more than 20000 cells");
  expect("validate nowhere.json", 2, "cannot be read");
  expect("report nowhere", 2, "cannot be read");
  expect("diff a.pfm b.pfm", 2, "cannot be read");
  expect("bench --benchmark_filter=nothing_of_this_name", 2, "matches no benchmark");
  expect("bench --benchmark_filer=x", 2, "unknown flag");
}

TEST_F(Cli, BrokenSceneFilesSayWhere) {
  folder_.write("broken.json", "{\n  \"title\": oops\n}");
  expect("render ./broken.json -m reference -o a.pfm", 2, "broken.json:2:");
}

TEST_F(Cli, ListAsJson) {
  const Said said = volumark("list --json");
  const Json json = Json::parse(said.text);
  for (const char* kind : {"scenes", "methods", "backends", "experiments"}) EXPECT_FALSE(json[kind].empty()) << kind;
  EXPECT_EQ(Json::parse(volumark("list methods --json").text).size(), 1U);
}

TEST_F(Cli, RenderThenDiff) {
  expect("render slab -m reference --size 24x16 -o ref.pfm", 0, "largest error bound");
  expect("render slab -m raycast -b cpu --size 24x16 -o ray.pfm", 0, "raycast on cpu");
  expect("diff ray.pfm ref.pfm --max-rmse 0.001", 0, "rmse");
  expect("render slab -m raycast -b null --size 24x16 -o black.pfm", 0, "");
  expect("diff black.pfm ref.pfm", 0, "rmse");
  expect("diff black.pfm ref.pfm --max-rmse 0.001 --out diff.pfm", 1, "above its limit");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "diff.pfm"));
  expect("render slab -m reference --size 8x8 -o small.pfm", 0, "");
  expect("diff small.pfm ref.pfm", 2, "unequal size");
  EXPECT_TRUE(Json::parse(volumark("diff ray.pfm ref.pfm --json").text).contains("flip_p99"));
}

TEST_F(Cli, ProbeFollowsOnePixel) {
  const std::string two = "probe slab -p 16,16 --size 32x32 -m texture3d_slices -m raycast --depths 9 ";
  expect(two + "--out p.json", 0, "A and B do not part");
  const Json json = Json::parse(text_of_file(folder_.path() / "p.json"));
  EXPECT_EQ(json["curves"].size(), 3U);  // and the reference
  EXPECT_NEAR(json["curves"][0]["samples"][8]["transmittance"].get<double>(), std::exp(-1.0), 1e-5);
  expect(two + "--set texture3d_slices:opacity_correction=linear --set step=4 --out p.html", 0,
         "A and B part at depth");
  EXPECT_NE(text_of_file(folder_.path() / "p.html").find("<svg"), std::string::npos);
  expect("probe slab -p 96,96 -m raycast -m raycast --set A:step=2 --set B:step=1 --depths 3", 0, "raycast step=1");
  expect("probe slab -p 400,16 -m raycast", 2, "pixel 400,16 is not in the picture: it is 192x192");
  expect("probe slab -p 0,0 -m raycast", 2, "misses the volume");
  expect("probe slab -p 1 -m raycast", 2, "--pixel: expected x,y");
  expect("probe slab -p 9,9 -m raycast --view 99", 2, "views 0 to 7");
  expect("probe slab -p 9,9 -m raycst", 2, "did you mean");
  expect("probe slab -p 9,9 -m raycast --set texture3d_slices:step=1", 2, "no --method that it speaks of");
  expect("probe slab -p 9,9 -m raycast --out p.pdf", 2, ".html, .json or .svg");
}

TEST_F(Cli, RunValidateReport) {
  write_experiment(0);
  expect("run ./tiny.json --out out", 0, "out/results.json");
  expect("validate out", 0, "valid, 12 results");
  expect("report out", 0, "");
  Json json = Json::parse(text_of_file(folder_.path() / "out" / "results.json"));
  json["results"][0]["outcome"] = "fine";
  folder_.write("bad.json", json.dump());
  expect("validate bad.json", 1, "/results/0/outcome");
  json["schema"]["version"] = "9.0.0";
  folder_.write("bad.json", json.dump());
  expect("report bad.json", 2, "cannot be read: this program knows version 1");
}

TEST_F(Cli, VerifyWritesResultsAndNamesItsCases) {
  expect("verify --list", 0, "not there yet: needs an octree");
  expect("verify --case slap --backend cpu", 2, "did you mean");
  expect("verify --backend cp", 2, "unknown backend");
  expect("verify --case 23b,sphere_field --backend cpu --out verified", 0, "2 cases, ");
  expect("validate verified", 0, "valid");
  const Json results = Json::parse(text_of_file(folder_.path() / "verified" / "results.json"));
  ASSERT_FALSE(results["hard_cases"].empty());
  for (const Json& row : results["hard_cases"]) {
    EXPECT_EQ(row["outcome"], "pass") << row.dump();
    EXPECT_LE(row["deviation"].get<double>(), row["bound"].get<double>()) << row.dump();
  }
  const Said said = volumark("verify --case sphere_field --backend cpu --json");
  EXPECT_EQ(said.code, 0);
  EXPECT_EQ(Json::parse(said.text)["hard_cases"][0]["id"], "sphere_field");
}

TEST_F(Cli, OneCellRunsAgainByItsCommand) {
  write_experiment(0);
  volumark("run ./tiny.json --out out");
  const Json json = Json::parse(text_of_file(folder_.path() / "out" / "results.json"));
  const std::string command = json["results"][5]["command"];
  ASSERT_TRUE(command.starts_with("volumark ")) << command;
  expect(command.substr(9), 0, "out/again/results.json");
  const Json again = Json::parse(text_of_file(folder_.path() / "out/again" / "results.json"));
  ASSERT_EQ(again["results"].size(), 1U);
  EXPECT_EQ(again["results"][0]["key"], json["results"][5]["key"]);
}

TEST_F(Cli, ASweptCellRunsAgainByItsCommand) {
  write_experiment(0);
  expect("run ./tiny.json --out out --sweep table_size=64,256", 0, "out/results.json");
  const Json json = Json::parse(text_of_file(folder_.path() / "out" / "results.json"));
  const Json& cell = json["results"][2];
  const std::string command = cell["command"];
  EXPECT_NE(command.find(" --sweep table_size="), std::string::npos) << command;
  expect(command.substr(9), 0, "out/again/results.json");
  const Json again = Json::parse(text_of_file(folder_.path() / "out/again" / "results.json"));
  ASSERT_EQ(again["results"].size(), 1U);
  EXPECT_EQ(again["results"][0]["key"], cell["key"]);
  expect("run ./tiny.json --out out --resume", 2, "--sweep: table_size=64,256, now none");
}

TEST_F(Cli, AKillLosesOneCellAtMostAndResumeGoesOn) {
  write_experiment(0.2);
  const pid_t child = start("run ./tiny.json --out out");
  ASSERT_TRUE(wait_for_cells(3));
  expect("run ./tiny.json --out out", 2, "another run works in this folder");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const size_t kept = cells_on_disk();
  EXPECT_GE(kept, 3U);
  expect("validate out", 0, "valid");
  expect("run ./tiny.json --out out", 2, "--resume");
  const Said resumed = volumark("run ./tiny.json --out out --resume");
  EXPECT_EQ(resumed.code, 0) << resumed.text;
  EXPECT_NE(resumed.text.find("cells were measured before"), std::string::npos) << resumed.text;
  expect("validate out", 0, "valid, 12 results");
}

TEST_F(Cli, AnInterruptEndsCleanly) {
  write_experiment(0.2);
  const pid_t child = start("run ./tiny.json --out out");
  ASSERT_TRUE(wait_for_cells(2));
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  expect("validate out", 0, "valid");
  EXPECT_TRUE(Json::parse(text_of_file(folder_.path() / "out" / "results.json"))["run"]["interrupted"].get<bool>());
}

}  // namespace
}  // namespace volumark
