// When an image counts as wrong.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "harness/metrics/metrics.h"
#include "reports/results.h"

namespace volumark {

// The metrics' figures in the form of the results file; absent ones become NaN (PSNR of equal images: infinity).
ErrorMetrics error_metrics(const Errors& errors);

// Of each metric the worst, or the mean, over the views. Throws std::invalid_argument for none.
CellError over_views(const std::vector<ErrorMetrics>& views);

// Pixels that are not finite fail alone; then each limit (rmse, max, bias, flip_p99) in turn. The reason names the
// figure and its limit; nothing where the image passes.
std::optional<std::string> wrong_image_reason(const ErrorMetrics& worst, const std::map<std::string, double>& limits);

}  // namespace volumark
