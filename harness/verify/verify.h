// The stability suite: hard cases with an answer in closed form or with a proved bound, for every method on every
// backend, and how a picture follows small motions of the camera. Part of the product, since a new driver or a new GPU
// is where users want to run it. Every case applies to every method unless the method exempts it and says why.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "methods/method.h"
#include "reports/results.h"
#include "scenes/scene_io.h"

namespace volumark {

// What one run of a case is given.
enum class CaseNeeds {
  Method,    // a method on one backend
  Backends,  // a method on all backends at once
  Scenes,    // a method on one backend, over the shipped scenes (with Backends: see agreement)
  Host,      // nothing: tables, readers, the reference
  Absent,    // techniques that are not there yet
};

class CaseRun;  // harness/verify/case_run.h

struct HardCase {
  const char* id;      // snake_case, unique
  const char* number;  // in the list of hard cases
  const char* title;   // one line
  const char* source;  // where the answer comes from; of an absent case: what it waits for
  CaseNeeds needs;
  void (*check)(CaseRun&);  // null where Absent
};
// The one list of cases (harness/verify/case_list.cpp), by number.
std::span<const HardCase> hard_case_list();

struct VerifyOptions {
  std::vector<std::string> backends;        // empty: all that draw
  std::vector<std::string> methods, cases;  // names; ids or numbers; empty: all
  std::vector<const Method*> method_list;   // empty: the list of methods/methods.cpp
  DeviceOptions device;
  bool require_backends = false;  // one that cannot be opened is an error, not left out with its reason
  DataOptions data;
  std::optional<std::filesystem::path> out;  // folder for the pictures of the worst and of the failing rows
  const std::atomic<bool>* stop = nullptr;
};

struct VerifyOutcome {
  std::vector<HardCaseRow> rows;
  std::vector<SensitivityRow> sensitivity;
  std::vector<BackendResultInfo> backends;  // those that were opened
  std::vector<SceneResultInfo> scenes;      // of the sensitivity rows
  bool interrupted = false;
};

// Runs the cases that `options` choose. `progress` hears one line a case and method. A case or a method that throws
// gives a row of outcome "error"; throws std::invalid_argument (with the nearest name) for an unknown case, method or
// backend, and for a method that exempts a case which is not in the list.
VerifyOutcome verify(const VerifyOptions& options, const std::function<void(const std::string&)>& progress = {});

// The rows alone.
std::vector<HardCaseRow> run_hard_cases(const VerifyOptions& options,
                                        const std::function<void(const std::string&)>& progress = {});

// "19 cases, 402 checks, worst deviation 0.71 of its bound, in sphere (raycast, gl); 3 failed"
std::string verify_summary(const VerifyOutcome& outcome);
// Whether any row failed or ended in an error.
bool verify_failed(const VerifyOutcome& outcome);

// Deviation over bound; infinite where the bound is 0 and the deviation is not.
double share_of_bound(const HardCaseRow& row);

}  // namespace volumark
