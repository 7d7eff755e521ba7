// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/instantiate.hpp>

#include <Eigen/Core>

namespace talus {

/// c -= a b, in the thread that calls. Where a program is compiled with OpenMP, Eigen itself shares
/// large products among threads and cuts them up by their number, so that the last bits depend on
/// it; this takes the same kernel past that. None of the three may overlap.
TALUS_FUNCTION void subtract_product(Eigen::Ref<Eigen::MatrixXd> c,
                                     Eigen::Ref<const Eigen::MatrixXd> a,
                                     Eigen::Ref<const Eigen::MatrixXd> b);

#if TALUS_BODIES

TALUS_FUNCTION void subtract_product(Eigen::Ref<Eigen::MatrixXd> c,
                                     Eigen::Ref<const Eigen::MatrixXd> a,
                                     Eigen::Ref<const Eigen::MatrixXd> b) {
    TALUS_CHECK(a.rows() == c.rows() && a.cols() == b.rows() && b.cols() == c.cols(),
                "sizes must fit");
    using Index = Eigen::Index;
    const Index rows = c.rows(), columns = c.cols(), depth = a.cols();
    constexpr Index small = 20;  // as in Eigen: below, packing costs more than it saves
    if (rows + columns + depth < small) {
        c -= a.lazyProduct(b);
        return;
    }
    if (columns == 1) {
        c.col(0).noalias() -= a * b.col(0);
        return;
    }
    constexpr int by_columns = Eigen::ColMajor, any = Eigen::Dynamic;
    using Kernel =
        Eigen::internal::general_matrix_matrix_product<Index, double, by_columns, false, double,
                                                       by_columns, false, by_columns, 1>;
    Eigen::internal::gemm_blocking_space<by_columns, double, double, any, any, any, 1, false>
        blocking(rows, columns, depth, 1, true);
    Kernel::run(rows, columns, depth, a.data(), a.outerStride(), b.data(), b.outerStride(),
                c.data(), 1, c.outerStride(), -1.0, blocking, nullptr);
}

#endif

}  // namespace talus
