// The keys "paper" and "claims" of an experiment file. Strict: a name that is not known, a rule without what it needs
// and a selector that chooses no cell of the experiment are errors with their place in the file.
#pragma once

#include "harness/claims.h"
#include "harness/experiment.h"
#include "scenes/json_reader.h"

namespace volumark {

// `object`: the whole file; `experiment`: with its scenes, methods and backends. Throws SceneError.
Claims parse_claims(const JsonObject& object, const Experiment& experiment);

}  // namespace volumark
