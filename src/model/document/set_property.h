// The property edits of Document: one template serves them all.
#pragma once

#include "model/document/document.h"

namespace windfall::model {}  // namespace windfall::model
