// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bytes.hpp"

namespace fuzz {

void run_shim(Bytes& bytes);

}  // namespace fuzz
