// SPDX-License-Identifier: BSL-1.0
#include "settle.hpp"

std::unique_ptr<pile::Job> pile::space_job(const Options& options) {
    return std::make_unique<Settling<3>>(options);
}
