// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>

namespace talus {

template <int Rows, int Cols, class Real>
class SmallMatrix;
template <int Rows, int Cols, class Real, int Inner, int Outer>
class MatrixPart;

// NOLINTBEGIN(readability-const-return-type,bugprone-branch-clone)

/// The parts of a SmallMatrix, by Eigen's names. Those of one that may change are MatrixParts:
/// values, assignments to which reach the matrix. Those of a constant one are the values.
template <int Rows, int Cols, class Real>
class PartsOfMatrix {
  public:
    using Index = std::ptrdiff_t;
    // Constant, so that what would be lost, since it would change the value alone, does not
    // compile.
    template <int R, int C>
    using Part = const MatrixPart<R, C, Real, 1, Rows>;
    template <int R, int C>
    using PartValue = const SmallMatrix<R, C, Real>;

    template <int R, int C>
    Part<R, C> block(Index i, Index j) {
        return MatrixPart<R, C, Real, 1, Rows>(&self()(i, j));
    }
    template <int R, int C>
    PartValue<R, C> block(Index i, Index j) const {
        SmallMatrix<R, C, Real> r;
        for (int l = 0; l < C; ++l)
            for (int k = 0; k < R; ++k) r.data()[k + l * R] = self()(i + k, j + l);
        return r;
    }
    template <int N>
    decltype(auto) segment(Index k) {
        if constexpr (Cols == 1)
            return block<N, 1>(k, 0);
        else
            return block<1, N>(0, k);
    }
    template <int N>
    decltype(auto) segment(Index k) const {
        if constexpr (Cols == 1)
            return block<N, 1>(k, 0);
        else
            return block<1, N>(0, k);
    }
    template <int N>
    decltype(auto) head() {
        return segment<N>(0);
    }
    template <int N>
    decltype(auto) head() const {
        return segment<N>(0);
    }
    template <int N>
    decltype(auto) tail() {
        return segment<N>(Rows * Cols - N);
    }
    template <int N>
    decltype(auto) tail() const {
        return segment<N>(Rows * Cols - N);
    }
    template <int N>
    decltype(auto) topRows() {
        return block<N, Cols>(0, 0);
    }
    template <int N>
    decltype(auto) topRows() const {
        return block<N, Cols>(0, 0);
    }
    template <int N>
    decltype(auto) bottomRows() {
        return block<N, Cols>(Rows - N, 0);
    }
    template <int N>
    decltype(auto) bottomRows() const {
        return block<N, Cols>(Rows - N, 0);
    }
    template <int N>
    decltype(auto) middleRows(Index i) {
        return block<N, Cols>(i, 0);
    }
    template <int N>
    decltype(auto) middleRows(Index i) const {
        return block<N, Cols>(i, 0);
    }
    template <int N>
    decltype(auto) leftCols() {
        return block<Rows, N>(0, 0);
    }
    template <int N>
    decltype(auto) leftCols() const {
        return block<Rows, N>(0, 0);
    }
    template <int N>
    decltype(auto) rightCols() {
        return block<Rows, N>(0, Cols - N);
    }
    template <int N>
    decltype(auto) rightCols() const {
        return block<Rows, N>(0, Cols - N);
    }
    template <int N>
    decltype(auto) middleCols(Index j) {
        return block<Rows, N>(0, j);
    }
    template <int N>
    decltype(auto) middleCols(Index j) const {
        return block<Rows, N>(0, j);
    }
    template <int R, int C>
    decltype(auto) topLeftCorner() {
        return block<R, C>(0, 0);
    }
    template <int R, int C>
    decltype(auto) topLeftCorner() const {
        return block<R, C>(0, 0);
    }
    template <int R, int C>
    decltype(auto) topRightCorner() {
        return block<R, C>(0, Cols - C);
    }
    template <int R, int C>
    decltype(auto) topRightCorner() const {
        return block<R, C>(0, Cols - C);
    }
    template <int R, int C>
    decltype(auto) bottomLeftCorner() {
        return block<R, C>(Rows - R, 0);
    }
    template <int R, int C>
    decltype(auto) bottomLeftCorner() const {
        return block<R, C>(Rows - R, 0);
    }
    template <int R, int C>
    decltype(auto) bottomRightCorner() {
        return block<R, C>(Rows - R, Cols - C);
    }
    template <int R, int C>
    decltype(auto) bottomRightCorner() const {
        return block<R, C>(Rows - R, Cols - C);
    }
    Part<1, Cols> row(Index i) { return block<1, Cols>(i, 0); }
    Part<Rows, 1> col(Index j) { return block<Rows, 1>(0, j); }
    PartValue<1, Cols> row(Index i) const { return block<1, Cols>(i, 0); }
    PartValue<Rows, 1> col(Index j) const { return block<Rows, 1>(0, j); }
    const MatrixPart<(Rows < Cols ? Rows : Cols), 1, Real, Rows + 1, 0> diagonal() {
        return MatrixPart<(Rows < Cols ? Rows : Cols), 1, Real, Rows + 1, 0>(self().data());
    }
    PartValue<(Rows < Cols ? Rows : Cols), 1> diagonal() const {
        SmallMatrix<(Rows < Cols ? Rows : Cols), 1, Real> r;
        for (int i = 0; i < r.size(); ++i) r.data()[i] = self().data()[i * (Rows + 1)];
        return r;
    }

    // Of sizes that are known at run time only: Eigen's, lazy as ever.
    auto head(Index n) { return self().eigen().head(n); }
    auto head(Index n) const { return self().eigen().head(n); }
    auto tail(Index n) { return self().eigen().tail(n); }
    auto tail(Index n) const { return self().eigen().tail(n); }
    auto segment(Index k, Index n) { return self().eigen().segment(k, n); }
    auto segment(Index k, Index n) const { return self().eigen().segment(k, n); }
    auto block(Index i, Index j, Index m, Index n) { return self().eigen().block(i, j, m, n); }
    auto block(Index i, Index j, Index m, Index n) const {
        return self().eigen().block(i, j, m, n);
    }

  private:
    using Self = SmallMatrix<Rows, Cols, Real>;
    Self& self() { return *static_cast<Self*>(this); }
    const Self& self() const { return *static_cast<const Self*>(this); }
};

// NOLINTEND(readability-const-return-type,bugprone-branch-clone)

}  // namespace talus
