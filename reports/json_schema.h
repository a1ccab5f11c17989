// Checks a JSON value against a JSON Schema (2020-12), for the keywords that our schemas use: $ref into $defs, type,
// enum, const, properties, required, additionalProperties, propertyNames, items, minItems, maxItems, minimum, maximum,
// exclusiveMinimum, minLength, pattern, if/then/else, allOf, anyOf. A schema with another keyword is refused
// (std::invalid_argument), so that nothing is silently left unchecked.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "reports/results.h"

namespace volumark {

std::vector<SchemaFault> validate_json(const nlohmann::json& schema, const nlohmann::json& value);

}  // namespace volumark
