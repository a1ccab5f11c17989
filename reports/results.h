// The results file: plain structs, one JSON text. All that tables, the HTML report and comparisons may know comes from
// here, so that an old file can be reported again. Depends on nothing else of the house.
// Seconds are stored, never frames per second. A number that is not finite is written as null, with its reason in
// `nulls` of the result (JSON pointer inside that result -> "nan", "infinity" or "-infinity"); read_results restores
// it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace volumark {

inline constexpr const char* kResultsSchemaName = "volumark-results";
inline constexpr int kResultsSchemaMajor = 1;
inline constexpr const char* kResultsSchemaVersion = "1.1.0";

// A file that cannot be read, written or understood: message with the path and, inside it, the JSON pointer.
class ResultsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using ParamValue = std::variant<bool, int64_t, double, std::string>;
using Params = std::map<std::string, ParamValue, std::less<>>;

// ---- Of the whole run -----------------------------------------------------------------------------------------------

struct RunInfo {
  std::string id;                       // unique: start time and a hash
  std::string started_at, finished_at;  // UTC, ISO 8601; finished_at is empty while it runs or when it was killed
  std::vector<std::string> argv;
  std::string order;  // how cells and repetitions were ordered, in words
  int64_t seed = 0;   // of everything random in the run
  bool interrupted = false;
  int64_t resumed = 0;                        // how often --resume went on with it
  std::vector<std::string> sweeps;            // --sweep, each as name=value,value,...
  std::map<std::string, std::string> device;  // options that figures depend on: threads, gl_platform, ...
};

struct GitInfo {
  std::string sha, branch, commit_date;
  bool dirty = false;
};

struct BuildInfo {
  std::string compiler, version, flags, type;  // "GNU", "12.2.0", "-O3 ...", "Release"
};

struct MachineInfo {
  std::string cpu, os, hypervisor;  // hypervisor: empty on bare metal
  int64_t cores = 0, ram_bytes = 0;
  std::array<double, 3> load_before{}, load_after{};  // 1, 5, 15 minutes
  std::map<std::string, std::string> env;             // variables that change drivers or threads, where set
};

struct BackendResultInfo {
  std::string id, api, vendor, renderer, version, driver, llvm;
  int64_t simd_bits = 0, threads = 0;
  bool software = true;  // never ranked against hardware
  std::map<std::string, std::string> env;
  std::vector<std::string> capabilities, workarounds;
  // Texture format -> distinct values met between two neighbouring texels 0 and 1 under linear filtering, of the 4096
  // places that were asked for. About 256: the driver filters with 8 bits, and that is an error of 1/255 of its own.
  std::map<std::string, double> filter_levels;
};

struct SceneResultInfo {
  std::string name, title, description, hash;
  std::array<int64_t, 3> voxels{};
  std::string voxel_type, licence, origin;
  std::vector<std::string> effects, views;  // views: names, in the scene's order
  std::array<double, 3> background{};       // linear RGB; images are drawn over it
  std::string display = "direct";           // what it shows: direct, isosurface, slice_plane, shell
};

struct ParameterResultInfo {
  std::string name, unit, doc;
  bool quality_axis = false;
};

struct MethodResultInfo {
  std::string name, title, paper;
  std::vector<ParameterResultInfo> parameters;
};

struct ExperimentResultInfo {
  std::string name, title, description;
  std::map<std::string, double> limits;  // metric -> worst allowed value (rmse, max, flip_p99, bias, parity)
};

// A published check value of a metric against what this build computes.
struct SelfTestRow {
  std::string metric, name, source;
  double expected = 0, measured = 0, tolerance = 0;
  bool ok = false;
};

// ---- Of one cell ----------------------------------------------------------------------------------------------------

enum class Outcome { Ok, Unsupported, Failed, Timeout, WrongImage };
const char* to_string(Outcome outcome);  // ok, unsupported, failed, timeout, wrong_image

struct CellKey {
  std::string experiment, scene, method, backend;
  Params params;  // every parameter of the method; with the others it alone identifies a series
  // Effects switched against the scene's own list: "" = as the scene says, "none", "only lighting", "without lighting".
  std::string variant;
  friend bool operator==(const CellKey&, const CellKey&) = default;
};

struct Quality {
  std::string parameter;  // the method's quality axis; empty: it has none
  double value = 0;
};

// Of samples of several views: `median` is the mean over the views of each view's median (a median of the pooled
// samples would be that of some view in the middle, and jump when another one takes its place), and
// median_lo..median_hi the 95 % percentile bootstrap of that same figure, samples drawn anew within each view. Of one
// view: its plain median. All others are of the pooled samples. (Files of version 1.0 hold the pooled median.)
struct Stats {
  int64_t count = 0;
  double median = 0, p5 = 0, p95 = 0, mean = 0, min = 0, max = 0;
  double median_lo = 0, median_hi = 0;
};

struct Metric {
  std::string unit = "s", better = "less";  // better: less or more
  std::vector<double> samples;              // in measured order; the first frame is not among them
  std::vector<int64_t> views;               // view index of each sample
  std::optional<double> first;              // of the first frame after prepare (compilation, allocation)
  Stats stats;
};

struct PrepareCost {
  double wall = 0, cpu = 0;             // seconds
  std::map<std::string, double> zones;  // seconds
};

struct PeakBytes {
  int64_t device = 0;   // largest sum of buffers and textures alive on the Device
  int64_t process = 0;  // peak resident set of the process while the cell was made ready and drawn for the first time,
                        // less what other open cells of its group held; where the system cannot reset the mark: so far
  int64_t voxels = 0;   // bytes of the scene's voxels, for comparison
  int64_t target = 0;   // bytes of the colour target
};

struct Timing {
  std::string stopped;               // "precision", "budget" or "count": why sampling ended
  double precision = 0, budget = 0;  // wanted relative width of the median's interval; seconds allowed
};

struct Metrics {
  Metric frame_wall, frame_cpu;         // of every view measured
  std::map<std::string, Metric> zones;  // frame zones, seconds
  PrepareCost prepare;
  std::map<std::string, double> counters;  // mean over the views; exact values are in each view
  PeakBytes peak_bytes;
  Timing timing;
};

struct ImageFile {
  std::string path;  // relative to the results file
  std::string sha256;
  int64_t width = 0, height = 0;
  std::string colourspace;  // "linear", "srgb"; "data" for maps
  std::string preview;      // an 8-bit PNG of the same picture, relative path; empty where there is none
};

struct ReferenceInfo {
  std::string id;                    // the cache key
  std::string sha256;                // of the pixels
  double bound = 0;                  // largest error bound of any channel of any pixel
  bool estimate = false;             // the bound is an estimate, not a proof
  std::vector<std::string> without;  // effects of the scene that the reference does not draw either
};

struct RegionError {
  int64_t pixels = 0;
  double rmse = 0, max = 0, mae = 0;
};

// On linear float RGB over the scene's background (alpha apart), test against reference. `worst` of a cell takes the
// worst of each metric over the views, so its numbers may come from different views.
struct ErrorMetrics {
  int64_t pixels = 0;      // compared
  int64_t non_finite = 0;  // pixels with NaN or infinity; the other numbers leave them out
  double mae = 0, rmse = 0, max = 0;
  int64_t max_x = -1, max_y = -1;                    // where `max` is; -1: nowhere
  double psnr = 0;                                   // infinity where equal
  std::array<double, 3> bias{};                      // signed mean of test - reference, R G B
  double p50 = 0, p95 = 0, p99 = 0, over_1_255 = 0;  // of the largest channel error of a pixel; fraction above 1/255
  double ssim = 1;                                   // NaN for images below 11 x 11
  double flip_mean = 0, flip_p99 = 0;
  double ciede2000_mean = 0, ciede2000_p99 = 0;
  double alpha_mae = 0, alpha_rmse = 0, alpha_max = 0;
  std::map<std::string, RegionError> regions;  // silhouette, grazing, interior, background
};

struct ViewResult {
  int64_t index = 0;  // in the scene
  std::string name;
  std::optional<Stats> frame_wall, frame_cpu;  // of this view alone; absent where it was not timed
  std::map<std::string, int64_t> counters;     // exact
  std::optional<ReferenceInfo> reference;
  std::optional<ErrorMetrics> error;
  bool at_bound = false;       // the largest error is below the reference's bound: no ranking below it
  bool shows_nothing = false;  // the reference shows the background alone: the errors praise nothing
  std::optional<double> jump;  // from the view before, where that is a neighbour: harness/jump.h
  // Kept where the experiment keeps images.
  std::optional<ImageFile> rendered, reference_image, difference, flip;
};

struct CellError {
  ErrorMetrics worst, mean;  // of each metric over the views
};

struct OrderInfo {
  double expected = 0;           // 0: not stated
  std::optional<double> fitted;  // of the series that this cell belongs to
};

// What a paper prints for this cell. `rule` is always "absolute": figures of the paper's machine are shown, not judged.
struct PaperCell {
  std::string key, table, cell, unit, rule;  // key: of the paper; unit: frames/s, s, ms, bytes, KiB, MiB, or a word
  double published = 0;                      // in `unit`; NaN: a plot without a number
  std::string measure = "frame_wall";        // what of the cell stands beside it (reports/measures.h)
};

// One stage of a program as it runs: specialised, then optimised.
struct ProgramCost {
  std::string program, stage;  // label; vertex, fragment, geometry, compute
  int64_t instructions = 0;    // SPIR-V instructions in function bodies; the same for every backend that runs GLSL
};

struct Result {
  CellKey key;
  std::string case_version;  // hash of scene, parameters, views, size and reference: an edited case is a new series
  Outcome outcome = Outcome::Failed;
  std::string reason;                        // of every outcome but ok; of an ok without an error
  std::vector<std::string> effects;          // that were simulated
  std::vector<std::string> ignored_effects;  // that the scene calls for and --ignore-effects left out: the picture
                                             // lacks them
  std::vector<ProgramCost> programs;
  int64_t width = 0, height = 0;
  std::optional<Quality> quality;
  std::optional<Metrics> metrics;  // absent where nothing was drawn
  std::vector<ViewResult> views;
  std::optional<CellError> error;  // absent where there is no reference or no image
  OrderInfo order;
  std::optional<PaperCell> paper;
  std::string command;  // runs this cell again
  std::string finished_at;
};

// ---- Over cells -----------------------------------------------------------------------------------------------------

// The error (RMSE, worst view) along the quality axis: error ~ step^order, fitted where it still falls.
struct Convergence {
  CellKey key;  // without the quality parameter in params
  std::string parameter;
  std::vector<double> values, errors;  // coarse to fine
  int64_t fitted_points = 0;           // 0: no fit possible
  double fitted = 0, fitted_lo = 0, fitted_hi = 0, expected = 0;
  double floor = 0;          // smallest error reached; 0: still falling
  std::string floor_reason;  // what holds the error there, from the attribution; empty: not known, or no floor
  std::string verdict;       // "pass", "fail", "not stated", "not resolved" or "at the bound"; why: `reason`
  std::string reason;
};

// The same cell on two backends, pixel by pixel: the largest difference of the four premultiplied channels, apart for
// interior pixels and those at a silhouette.
struct ParityRow {
  CellKey key;        // backend is the first
  std::string other;  // the second backend
  int64_t view = 0;
  int64_t interior_pixels = 0, interior_over = 0;  // over: those above `limit`
  double interior_max = 0;
  int64_t silhouette_pixels = 0, silhouette_over = 0;
  double silhouette_max = 0;
  double limit = 0;
  bool ok = false;
};

// ---- Where the error comes from ----
// One parameter made ideal (ParameterInfo::ideal), all others as in the cell.
struct AttributionPart {
  std::string aspect;  // "target format", "volume texture", "step", ...
  std::string parameter;
  ParamValue from, to;
  double error = 0;    // RMSE, worst view, with this one made ideal; NaN: it could not be drawn, `note` says why
  double worth = 0;    // error^2 that it takes away, as a share of the cell's error^2; below 0: the error grew (two
                       // errors had cancelled)
  double seconds = 0;  // frame time with it made ideal: what the gain costs; 0: not measured
  std::string note;    // named causes: "gl filters R8 textures with 8 bits"
};
struct Attribution {
  CellKey key;           // of the cell that is explained
  double error = 0;      // RMSE, worst view
  double seconds = 0;    // its frame time
  double all_ideal = 0;  // RMSE with every part made ideal at once: what is left is the method's own, or the bound
  double bound = 0;      // of the reference
  std::vector<AttributionPart> parts;  // largest worth first
  std::string note;                    // why there is no all_ideal, or there are no parts
  std::string command;
};

// ---- Method against method ----
// Two cells of one scene and backend, each method at the finest value of its sweep, picture against picture.
struct PairRow {
  CellKey a, b;
  int64_t view = 0;                        // where rmse is largest
  double rmse = 0, max = 0, flip_p99 = 0;  // between the two pictures, worst view
  double noise_a = 0, noise_b = 0;         // largest difference of a second drawing of the same frame
  double bound = 0;                        // of the reference
  // "indistinguishable", "a" or "b" (closer to the reference; faster): decided only where the intervals part.
  std::string error_verdict, time_verdict;
  std::string reason;
};

// ---- What an effect costs ----
struct EffectRow {
  CellKey key;  // variant empty
  std::string effect;
  std::string mode;               // "single": it alone against none; "leave_one_out": all against all but it
  Stats with, without;            // frame wall time, seconds
  double rmse = 0, flip_p99 = 0;  // between the two pictures, worst view
  int64_t instructions_with = 0, instructions_without = 0;  // of all stages
  bool time_differs = false;                                // the two intervals of the median do not touch
};

// ---- Stability ----
struct HardCaseRow {
  std::string id;            // of the case, snake_case
  std::string number;        // in the list of hard cases: "1", "23b"
  std::string title, check;  // what this row measured
  std::string method, backend;
  double expected = 0, measured = 0;
  double deviation = 0, bound = 0;  // holds where deviation <= bound
  std::string outcome;              // pass, fail, error, not_applicable
  std::string reason;               // of every outcome but pass
  std::string source;               // where expected value and bound come from
  int64_t x = -1, y = -1;           // worst pixel
  std::optional<ImageFile> picture, difference;
  double seconds = 0;
  std::string command;
};

// Change of the picture for a small motion of the camera (hard case 24).
struct Spike {
  int64_t view = 0, x = 0, y = 0;
  double change = 0;  // of the largest channel, per motion of the scene's size
};
struct SensitivityRow {
  CellKey key;
  int64_t directions = 0;
  double motion = 0;                    // of the camera, in sizes of the scene
  double median = 0, p99 = 0, max = 0;  // change per motion, over pixels that change
  double limit = 0;                     // above it a pixel is a spike
  std::vector<Spike> spikes;            // the worst first, at most 32
  int64_t spike_count = 0;
  bool ok = false;
  std::string reason;
};

// A claim of a paper, judged on one backend: holds where the interval of the measured value lies within the limits.
struct Claim {
  std::string id, text, rule, verdict, reason;  // verdict: holds, fails, unknown, not_judged (rule absolute)
  double measured = 0, expected = 0;            // NaN: nothing measured, nothing stated
  std::string paper, experiment, backend;
  std::string measure;                       // "frame_wall", "error.rmse per counter.slices", ...
  double measured_lo = 0, measured_hi = 0;   // interval of the measured value
  std::optional<double> limit_lo, limit_hi;  // what it must lie within; absent: no limit on that side
  std::vector<CellKey> cells;                // that it was measured on
};

struct Results {
  std::string schema_name = kResultsSchemaName, schema_version = kResultsSchemaVersion;
  RunInfo run;
  GitInfo git;
  BuildInfo build;
  MachineInfo machine;
  std::vector<BackendResultInfo> backends;
  std::vector<ExperimentResultInfo> experiments;
  std::vector<SceneResultInfo> scenes;
  std::vector<MethodResultInfo> methods;
  std::vector<Result> results;
  std::vector<Convergence> convergence;
  std::vector<ParityRow> parity;
  std::vector<Claim> claims;
  std::vector<Attribution> attribution;
  std::vector<PairRow> pairs;
  std::vector<EffectRow> effects;
  std::vector<HardCaseRow> hard_cases;
  std::vector<SensitivityRow> sensitivity;
  std::vector<SelfTestRow> self_test;
};

// ---- Text -----------------------------------------------------------------------------------------------------------

nlohmann::json to_json(const Results& results);
nlohmann::json to_json(const Result& result);  // one line of the journal
// Throw ResultsError: another schema name, an unknown major version, a missing key or a wrong type (with its pointer).
// Keys that this version does not know are left out: a newer minor version can be read.
Results results_from_json(const nlohmann::json& json);
Result result_from_json(const nlohmann::json& json);

// `path`: the file, or the folder that holds results.json.
Results read_results(const std::filesystem::path& path);
// Written to a temporary file beside it, synced, then renamed: the old file stays until the new one is whole.
void write_results(const Results& results, const std::filesystem::path& file);

// Any text, in the same way; throws ResultsError (unwritable folder, disk full) and leaves no temporary file.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

// ---- Schema ---------------------------------------------------------------------------------------------------------

struct SchemaFault {
  std::string pointer;  // into the file that was checked
  std::string message;
};
// The text of results.schema.json (JSON Schema 2020-12), compiled in.
const char* results_schema_text();
// Every violation of the schema; empty where the file is valid.
std::vector<SchemaFault> validate_results(const nlohmann::json& json);

}  // namespace volumark
