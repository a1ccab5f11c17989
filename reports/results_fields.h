// Which JSON key each member of the results' structs has: one list that writing and reading share. `A` is a Writer or a
// Reader (results.cpp) with `field(key, member)`. A std::optional member may be absent; all others are required.
// `later(key, member)` is for members that came after version 1.0: where an older file lacks them, they keep their
// default.
#pragma once

#include "reports/results.h"

namespace volumark {

template <class A>
void fields(A& a, RunInfo& v) {
  a.field("id", v.id);
  a.field("started_at", v.started_at);
  a.field("finished_at", v.finished_at);
  a.field("argv", v.argv);
  a.field("order", v.order);
  a.field("seed", v.seed);
  a.field("interrupted", v.interrupted);
  a.field("resumed", v.resumed);
  a.later("sweeps", v.sweeps);
  a.later("device", v.device);
}

template <class A>
void fields(A& a, GitInfo& v) {
  a.field("sha", v.sha);
  a.field("branch", v.branch);
  a.field("commit_date", v.commit_date);
  a.field("dirty", v.dirty);
}

template <class A>
void fields(A& a, BuildInfo& v) {
  a.field("compiler", v.compiler);
  a.field("version", v.version);
  a.field("flags", v.flags);
  a.field("type", v.type);
}

template <class A>
void fields(A& a, MachineInfo& v) {
  a.field("cpu", v.cpu);
  a.field("cores", v.cores);
  a.field("ram_bytes", v.ram_bytes);
  a.field("os", v.os);
  a.field("hypervisor", v.hypervisor);
  a.field("load_before", v.load_before);
  a.field("load_after", v.load_after);
  a.field("env", v.env);
}

template <class A>
void fields(A& a, BackendResultInfo& v) {
  a.field("id", v.id);
  a.field("api", v.api);
  a.field("vendor", v.vendor);
  a.field("renderer", v.renderer);
  a.field("version", v.version);
  a.field("driver", v.driver);
  a.field("llvm", v.llvm);
  a.field("simd_bits", v.simd_bits);
  a.field("threads", v.threads);
  a.field("software", v.software);
  a.field("env", v.env);
  a.field("capabilities", v.capabilities);
  a.field("workarounds", v.workarounds);
  a.later("filter_levels", v.filter_levels);
}

template <class A>
void fields(A& a, SceneResultInfo& v) {
  a.field("name", v.name);
  a.field("title", v.title);
  a.field("description", v.description);
  a.field("hash", v.hash);
  a.field("voxels", v.voxels);
  a.field("voxel_type", v.voxel_type);
  a.field("licence", v.licence);
  a.field("origin", v.origin);
  a.field("effects", v.effects);
  a.field("views", v.views);
  a.field("background", v.background);
  a.later("display", v.display);
}

template <class A>
void fields(A& a, ParameterResultInfo& v) {
  a.field("name", v.name);
  a.field("unit", v.unit);
  a.field("doc", v.doc);
  a.field("quality_axis", v.quality_axis);
}

template <class A>
void fields(A& a, MethodResultInfo& v) {
  a.field("name", v.name);
  a.field("title", v.title);
  a.field("paper", v.paper);
  a.field("parameters", v.parameters);
}

template <class A>
void fields(A& a, ExperimentResultInfo& v) {
  a.field("name", v.name);
  a.field("title", v.title);
  a.field("description", v.description);
  a.field("limits", v.limits);
}

template <class A>
void fields(A& a, SelfTestRow& v) {
  a.field("metric", v.metric);
  a.field("name", v.name);
  a.field("source", v.source);
  a.field("expected", v.expected);
  a.field("measured", v.measured);
  a.field("tolerance", v.tolerance);
  a.field("ok", v.ok);
}

template <class A>
void fields(A& a, CellKey& v) {
  a.field("experiment", v.experiment);
  a.field("scene", v.scene);
  a.field("method", v.method);
  a.field("backend", v.backend);
  a.field("params", v.params);
  a.later("variant", v.variant);
}

template <class A>
void fields(A& a, Quality& v) {
  a.field("parameter", v.parameter);
  a.field("value", v.value);
}

template <class A>
void fields(A& a, Stats& v) {
  a.field("count", v.count);
  a.field("median", v.median);
  a.field("p5", v.p5);
  a.field("p95", v.p95);
  a.field("mean", v.mean);
  a.field("min", v.min);
  a.field("max", v.max);
  a.field("median_lo", v.median_lo);
  a.field("median_hi", v.median_hi);
}

template <class A>
void fields(A& a, Metric& v) {
  a.field("unit", v.unit);
  a.field("better", v.better);
  a.field("samples", v.samples);
  a.field("views", v.views);
  a.field("first", v.first);
  a.field("stats", v.stats);
}

template <class A>
void fields(A& a, PrepareCost& v) {
  a.field("wall", v.wall);
  a.field("cpu", v.cpu);
  a.field("zones", v.zones);
}

template <class A>
void fields(A& a, PeakBytes& v) {
  a.field("device", v.device);
  a.field("process", v.process);
  a.field("voxels", v.voxels);
  a.field("target", v.target);
}

template <class A>
void fields(A& a, Timing& v) {
  a.field("stopped", v.stopped);
  a.field("precision", v.precision);
  a.field("budget", v.budget);
}

template <class A>
void fields(A& a, Metrics& v) {
  a.field("frame_wall", v.frame_wall);
  a.field("frame_cpu", v.frame_cpu);
  a.field("zones", v.zones);
  a.field("prepare", v.prepare);
  a.field("counters", v.counters);
  a.field("peak_bytes", v.peak_bytes);
  a.field("timing", v.timing);
}

template <class A>
void fields(A& a, ImageFile& v) {
  a.field("path", v.path);
  a.field("sha256", v.sha256);
  a.field("width", v.width);
  a.field("height", v.height);
  a.field("colourspace", v.colourspace);
  a.field("preview", v.preview);
}

template <class A>
void fields(A& a, ReferenceInfo& v) {
  a.field("id", v.id);
  a.field("sha256", v.sha256);
  a.field("bound", v.bound);
  a.field("estimate", v.estimate);
  a.later("without", v.without);
}

template <class A>
void fields(A& a, RegionError& v) {
  a.field("pixels", v.pixels);
  a.field("rmse", v.rmse);
  a.field("max", v.max);
  a.field("mae", v.mae);
}

template <class A>
void fields(A& a, ErrorMetrics& v) {
  a.field("pixels", v.pixels);
  a.field("non_finite", v.non_finite);
  a.field("mae", v.mae);
  a.field("rmse", v.rmse);
  a.field("max", v.max);
  a.field("max_x", v.max_x);
  a.field("max_y", v.max_y);
  a.field("psnr", v.psnr);
  a.field("bias", v.bias);
  a.field("p50", v.p50);
  a.field("p95", v.p95);
  a.field("p99", v.p99);
  a.field("over_1_255", v.over_1_255);
  a.field("ssim", v.ssim);
  a.field("flip_mean", v.flip_mean);
  a.field("flip_p99", v.flip_p99);
  a.field("ciede2000_mean", v.ciede2000_mean);
  a.field("ciede2000_p99", v.ciede2000_p99);
  a.field("alpha_mae", v.alpha_mae);
  a.field("alpha_rmse", v.alpha_rmse);
  a.field("alpha_max", v.alpha_max);
  a.field("regions", v.regions);
}

template <class A>
void fields(A& a, ViewResult& v) {
  a.field("index", v.index);
  a.field("name", v.name);
  a.field("frame_wall", v.frame_wall);
  a.field("frame_cpu", v.frame_cpu);
  a.field("counters", v.counters);
  a.field("reference", v.reference);
  a.field("error", v.error);
  a.field("at_bound", v.at_bound);
  a.later("shows_nothing", v.shows_nothing);
  a.later("jump", v.jump);
  a.field("rendered", v.rendered);
  a.field("reference_image", v.reference_image);
  a.field("difference", v.difference);
  a.field("flip", v.flip);
}

template <class A>
void fields(A& a, CellError& v) {
  a.field("worst", v.worst);
  a.field("mean", v.mean);
}

template <class A>
void fields(A& a, OrderInfo& v) {
  a.field("expected", v.expected);
  a.field("fitted", v.fitted);
}

template <class A>
void fields(A& a, PaperCell& v) {
  a.field("key", v.key);
  a.field("table", v.table);
  a.field("cell", v.cell);
  a.field("unit", v.unit);
  a.field("rule", v.rule);
  a.field("published", v.published);
  a.later("measure", v.measure);
}

template <class A>
void fields(A& a, ProgramCost& v) {
  a.field("program", v.program);
  a.field("stage", v.stage);
  a.field("instructions", v.instructions);
}

template <class A>
void fields(A& a, Result& v) {
  a.field("key", v.key);
  a.field("case_version", v.case_version);
  a.field("outcome", v.outcome);
  a.field("reason", v.reason);
  a.field("effects", v.effects);
  a.later("ignored_effects", v.ignored_effects);
  a.later("programs", v.programs);
  a.field("width", v.width);
  a.field("height", v.height);
  a.field("quality", v.quality);
  a.field("metrics", v.metrics);
  a.field("views", v.views);
  a.field("error", v.error);
  a.field("order", v.order);
  a.field("paper", v.paper);
  a.field("command", v.command);
  a.field("finished_at", v.finished_at);
}

template <class A>
void fields(A& a, Convergence& v) {
  a.field("key", v.key);
  a.field("parameter", v.parameter);
  a.field("values", v.values);
  a.field("errors", v.errors);
  a.field("fitted_points", v.fitted_points);
  a.field("fitted", v.fitted);
  a.field("fitted_lo", v.fitted_lo);
  a.field("fitted_hi", v.fitted_hi);
  a.field("expected", v.expected);
  a.field("floor", v.floor);
  a.later("floor_reason", v.floor_reason);
  a.field("verdict", v.verdict);
  a.field("reason", v.reason);
}

template <class A>
void fields(A& a, ParityRow& v) {
  a.field("key", v.key);
  a.field("other", v.other);
  a.field("view", v.view);
  a.field("interior_pixels", v.interior_pixels);
  a.field("interior_over", v.interior_over);
  a.field("interior_max", v.interior_max);
  a.field("silhouette_pixels", v.silhouette_pixels);
  a.field("silhouette_over", v.silhouette_over);
  a.field("silhouette_max", v.silhouette_max);
  a.field("limit", v.limit);
  a.field("ok", v.ok);
}

template <class A>
void fields(A& a, Claim& v) {
  a.field("id", v.id);
  a.field("text", v.text);
  a.field("rule", v.rule);
  a.field("measured", v.measured);
  a.field("expected", v.expected);
  a.field("verdict", v.verdict);
  a.field("reason", v.reason);
  a.later("paper", v.paper);
  a.later("experiment", v.experiment);
  a.later("backend", v.backend);
  a.later("measure", v.measure);
  a.later("measured_lo", v.measured_lo);
  a.later("measured_hi", v.measured_hi);
  a.field("limit_lo", v.limit_lo);
  a.field("limit_hi", v.limit_hi);
  a.later("cells", v.cells);
}

template <class A>
void fields(A& a, AttributionPart& v) {
  a.field("aspect", v.aspect);
  a.field("parameter", v.parameter);
  a.field("from", v.from);
  a.field("to", v.to);
  a.field("error", v.error);
  a.field("worth", v.worth);
  a.field("seconds", v.seconds);
  a.field("note", v.note);
}

template <class A>
void fields(A& a, Attribution& v) {
  a.field("key", v.key);
  a.field("error", v.error);
  a.field("seconds", v.seconds);
  a.field("all_ideal", v.all_ideal);
  a.field("bound", v.bound);
  a.field("parts", v.parts);
  a.later("note", v.note);
  a.field("command", v.command);
}

template <class A>
void fields(A& a, PairRow& v) {
  a.field("a", v.a);
  a.field("b", v.b);
  a.field("view", v.view);
  a.field("rmse", v.rmse);
  a.field("max", v.max);
  a.field("flip_p99", v.flip_p99);
  a.field("noise_a", v.noise_a);
  a.field("noise_b", v.noise_b);
  a.field("bound", v.bound);
  a.field("error_verdict", v.error_verdict);
  a.field("time_verdict", v.time_verdict);
  a.field("reason", v.reason);
}

template <class A>
void fields(A& a, EffectRow& v) {
  a.field("key", v.key);
  a.field("effect", v.effect);
  a.field("mode", v.mode);
  a.field("with", v.with);
  a.field("without", v.without);
  a.field("rmse", v.rmse);
  a.field("flip_p99", v.flip_p99);
  a.field("instructions_with", v.instructions_with);
  a.field("instructions_without", v.instructions_without);
  a.field("time_differs", v.time_differs);
}

template <class A>
void fields(A& a, HardCaseRow& v) {
  a.field("id", v.id);
  a.field("number", v.number);
  a.field("title", v.title);
  a.field("check", v.check);
  a.field("method", v.method);
  a.field("backend", v.backend);
  a.field("expected", v.expected);
  a.field("measured", v.measured);
  a.field("deviation", v.deviation);
  a.field("bound", v.bound);
  a.field("outcome", v.outcome);
  a.field("reason", v.reason);
  a.field("source", v.source);
  a.field("x", v.x);
  a.field("y", v.y);
  a.field("picture", v.picture);
  a.field("difference", v.difference);
  a.field("seconds", v.seconds);
  a.field("command", v.command);
}

template <class A>
void fields(A& a, Spike& v) {
  a.field("view", v.view);
  a.field("x", v.x);
  a.field("y", v.y);
  a.field("change", v.change);
}

template <class A>
void fields(A& a, SensitivityRow& v) {
  a.field("key", v.key);
  a.field("directions", v.directions);
  a.field("motion", v.motion);
  a.field("median", v.median);
  a.field("p99", v.p99);
  a.field("max", v.max);
  a.field("limit", v.limit);
  a.field("spikes", v.spikes);
  a.field("spike_count", v.spike_count);
  a.field("ok", v.ok);
  a.field("reason", v.reason);
}

template <class A>
void fields(A& a, Results& v) {
  a.field("run", v.run);
  a.field("git", v.git);
  a.field("build", v.build);
  a.field("machine", v.machine);
  a.field("backends", v.backends);
  a.field("experiments", v.experiments);
  a.field("scenes", v.scenes);
  a.field("methods", v.methods);
  a.field("results", v.results);
  a.field("convergence", v.convergence);
  a.field("parity", v.parity);
  a.field("claims", v.claims);
  a.later("attribution", v.attribution);
  a.later("pairs", v.pairs);
  a.later("effects", v.effects);
  a.later("hard_cases", v.hard_cases);
  a.later("sensitivity", v.sensitivity);
  a.field("self_test", v.self_test);
}

}  // namespace volumark
