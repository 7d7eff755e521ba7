// SPDX-License-Identifier: BSL-1.0
#include "common/automatic.hpp"

template class talus::Automatic<2, talus::Coulomb<2>>;
template class talus::Automatic<3, talus::Coulomb<3>>;
