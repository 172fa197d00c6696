// Single numbers of a leaf on the command line.
#pragma once

#include <string>
#include <vector>

#include "model/leaf/leaf.h"
#include "sim/result.h"

namespace windfall::app {

/// What is wrong with "NAME=VALUE"; empty: nothing. Names are those of project.json: "veins.laterals", "shape.holes".
std::string wrongAssignment(const std::string& value);

/// Sets them one after the other. The error names the field and what was expected.
Status setParameters(const std::vector<std::string>& assignments, model::LeafParameters& parameters);

}  // namespace windfall::app
