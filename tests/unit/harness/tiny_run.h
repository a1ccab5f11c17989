// A whole run of a small scene on the cpu backend, for tests of what a run makes of its cells.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/runner.h"
#include "tests/unit/harness/test_folder.h"

namespace volumark {

class TinyRun : public testing::Test {
 protected:
  using Json = nlohmann::json;

  // 16^3 bytes of a smooth field, seen from two sides.
  Json scene() const {
    return {{"volumark_scene", 1},
            {"title", "tiny"},
            {"volume", {{"generator", {{"kind", "distance"}, {"size", 16}, {"type", "u8"}}}}},
            {"transfer",
             {{"points",
               {{{"value", 0}, {"colour", {1, 0.5, 0.2}}, {"extinction", 4}},
                {{"value", 1.2}, {"colour", {0.2, 0.5, 1}}, {"extinction", 0}}}},
              {"window", {0, 1.75}}}},
            {"views",
             {{{"orbit",
                {{"count", 2},
                 {"azimuth", 30},
                 {"elevation", 20},
                 {"distance", 3},
                 {"half_height", 1.5},
                 {"units", "world"},
                 {"target", {0, 0, 0}}}}}}}};
  }
  Json experiment(const Json& methods) const {
    return {{"name", "tiny"},
            {"scenes", {"./tiny_scene.json"}},
            {"methods", methods},
            {"backends", {"cpu"}},
            {"image_size", {32, 32}},
            {"images", "none"},
            {"sampling", {{"least", 2}, {"most", 2}, {"budget", 0}}}};
  }
  RunOutcome run(const Json& experiment, const Json& scene, bool resume = false) {
    folder_.write("tiny_scene.json", scene.dump());
    RunOptions options;
    options.experiments = {folder_.write("tiny.json", experiment.dump()).string()};
    options.out = folder_.path() / "out";
    options.cache = folder_.path() / "cache";
    options.resume = resume;
    options.overwrite = !resume;
    options.progress = log_;
    return run_experiments(options);
  }
  RunOutcome run(const Json& experiment) { return run(experiment, scene()); }
  ~TinyRun() override { std::fclose(log_); }

  TestFolder folder_;
  std::FILE* log_ = std::tmpfile();
};

}  // namespace volumark
