// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Contact problems in HDF5 files of FCLib's format. Needs the HDF5 C library: link talus::hdf5. As
/// that library usually is, these functions are for one thread at a time.
#include <talus/io/read_problem.hpp>
#include <talus/io/write_problem.hpp>
