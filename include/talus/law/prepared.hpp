// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/concepts.hpp>

#include <utility>

namespace talus {

/// What a law without the PreparableLaw extension keeps over the sweeps: its block of W.
template <int Rows>
struct PlainBlock {
    Matrix<Rows> W;  ///< diagonal Delassus block [1/kg]
};

/// The value that `prepare(law, W)` returns.
template <class Law, int Rows>
struct PreparedType {
    using type = PlainBlock<Rows>;
};
template <class Law, int Rows>
requires PreparableLaw<Law, Rows>
struct PreparedType<Law, Rows> {
    using type = decltype(std::declval<const Law&>().prepare(std::declval<const Matrix<Rows>&>()));
};
template <class Law, int Rows>
using Prepared = typename PreparedType<Law, Rows>::type;

/// What `law` wants to keep of W, for any law.
template <int Rows, ContactLaw<Rows> Law>
Prepared<Law, Rows> prepare(const Law& law, const Matrix<Rows>& w) {
    if constexpr (PreparableLaw<Law, Rows>)
        return law.prepare(w);
    else
        return {w};
}

/// The impulse that solves the one-contact problem whose present impulse r gives the velocity
/// u = W r + b, for any law.
template <int Rows, ContactLaw<Rows> Law>
Vector<Rows> improved(const Law& law, const Prepared<Law, Rows>& prepared, const Vector<Rows>& u,
                      const Vector<Rows>& r) {
    if constexpr (PreparableLaw<Law, Rows>)
        return law.improved(prepared, u, r);
    else
        return law.solve(LocalProblem<Rows>{prepared.W, u - prepared.W * r}, r);
}

}  // namespace talus
