// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace talus {

namespace detail {

/// Memory for n items of that size and alignment. Throws std::bad_alloc.
inline void* allocate(std::size_t n, std::size_t size, std::size_t alignment) {
    if (n > static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()) / size)
        throw std::bad_array_new_length();
    return alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
               ? ::operator new (n* size, std::align_val_t{alignment})
               : ::operator new(n* size);
}
[[gnu::noinline]] inline void deallocate(void* place, std::size_t alignment) noexcept {
    if (alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__)
        ::operator delete (place, std::align_val_t{alignment});
    else
        ::operator delete(place);
}

/// The memory of a Column, whatever it holds: what needs no type is compiled once, and out of line,
/// since a step has hundreds of places where a column moves or grows.
class ColumnMemory {
  public:
    ColumnMemory() noexcept = default;
    ColumnMemory(const ColumnMemory&) = delete;
    ColumnMemory& operator=(const ColumnMemory&) = delete;

  protected:
    ~ColumnMemory() = default;
    [[gnu::noinline]] void swap_memory(ColumnMemory& other) noexcept {
        std::swap(begin_, other.begin_);
        std::swap(end_, other.end_);
        std::swap(room_, other.room_);
    }
    /// Moves what there is, as bytes, to room for n items; an item has that size and alignment.
    [[gnu::noinline]] void move_bytes(std::size_t n, std::size_t size, std::size_t alignment) {
        void* const place = allocate(n, size, alignment);
        const auto used = static_cast<std::size_t>(bytes(end_) - bytes(begin_));
        if (used > 0) std::memcpy(place, begin_, used);
        deallocate(begin_, alignment);
        begin_ = place;
        end_ = bytes(place) + used;
        room_ = bytes(place) + n * size;
    }
    static char* bytes(void* place) { return static_cast<char*>(place); }

    void* begin_ = nullptr;
    void* end_ = nullptr;
    void* room_ = nullptr;
};

}  // namespace detail

/// One field of many bodies or contacts, one after the other in memory: what std::vector is, with
/// the members that talus needs, and any integer for an index. A compiler makes some sixty
/// functions of a std::vector for each type that it holds; a step holds seventy types, and this one
/// takes a sixth off the time to compile it (bench/README.md). It is a contiguous range, so a
/// std::span of it needs no word, and becomes a std::vector, or is made of one, where one is asked
/// for. References and iterators are lost where a std::vector's would be. What it holds moves
/// without an exception, and as its bytes where it needs no destructor (so no item of that kind
/// may know where it is).
template <class T>
class Column : private detail::ColumnMemory {
  public:
    using value_type = T;
    using iterator = T*;
    using const_iterator = const T*;

    Column() noexcept = default;
    explicit Column(std::size_t n) : Column() { resize(n); }
    Column(std::size_t n, const T& x) : Column() { assign(n, x); }
    Column(std::initializer_list<T> list) : Column() { append(list.begin(), list.end()); }
    Column(const std::vector<T>& list) : Column() {
        append(list.data(), list.data() + list.size());
    }
    explicit Column(std::span<const T> items) : Column() { append(items); }
    Column(const Column& other) : Column() { append(other.begin(), other.end()); }
    Column(Column&& other) noexcept { swap(other); }
    ~Column() {
        static_assert(std::is_nothrow_move_constructible_v<T>,
                      "what a Column holds must move without an exception");
        clear();
        detail::deallocate(begin_, alignof(T));
    }
    Column& operator=(const Column& other) {
        if (this != &other) {
            clear();
            append(other.begin(), other.end());
        }
        return *this;
    }
    Column& operator=(Column&& other) noexcept {
        swap(other);
        return *this;
    }
    operator std::vector<T>() const { return std::vector<T>(begin(), end()); }
    void swap(Column& other) noexcept { swap_memory(other); }
    friend void swap(Column& a, Column& b) noexcept { a.swap(b); }

    T* data() { return begin(); }
    const T* data() const { return begin(); }
    T* begin() { return static_cast<T*>(begin_); }
    T* end() { return static_cast<T*>(end_); }
    const T* begin() const { return static_cast<const T*>(begin_); }
    const T* end() const { return static_cast<const T*>(end_); }
    std::size_t size() const { return static_cast<std::size_t>(end() - begin()); }
    std::size_t capacity() const {
        return static_cast<std::size_t>(static_cast<const T*>(room_) - begin());
    }
    bool empty() const { return end_ == begin_; }

    T& operator[](std::integral auto i) {
        check(static_cast<std::size_t>(i));
        return begin()[i];
    }
    const T& operator[](std::integral auto i) const {
        check(static_cast<std::size_t>(i));
        return begin()[i];
    }
    T& front() { return (*this)[0]; }
    const T& front() const { return (*this)[0]; }
    T& back() { return (*this)[size() - 1]; }
    const T& back() const { return (*this)[size() - 1]; }

    void clear() { end_at(begin()); }
    /// Room for n in all, exactly.
    void reserve(std::size_t n) {
        if (n > capacity()) move_to_room_for(n);
    }
    [[gnu::noinline]] void resize(std::size_t n) {
        make_room(n);
        for (const T* const to = begin() + n; end() < to; end_ = end() + 1) ::new (end_) T();
        end_at(begin() + n);
    }
    [[gnu::noinline]] void resize(std::size_t n, const T& value) {
        // Which may be one of its own. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
        const T x = value;
        make_room(n);
        for (const T* const to = begin() + n; end() < to; end_ = end() + 1) ::new (end_) T(x);
        end_at(begin() + n);
    }
    void assign(std::size_t n, const T& value) {
        // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
        const T x = value;
        clear();
        resize(n, x);
    }
    /// In place of what there is; `items` are none of its own.
    void assign(std::span<const T> items) {
        clear();
        append(items);
    }
    template <class Iterator>
    requires(!std::integral<Iterator>) void assign(Iterator from, Iterator to) {
        clear();
        for (; from != to; ++from) push_back(*from);
    }
    void append(std::span<const T> items) { append(items.data(), items.data() + items.size()); }
    void push_back(T x) {
        if (end_ == room_) grow();
        ::new (end_) T(std::move(x));
        end_ = end() + 1;
    }
    void pop_back() { end_at(end() - 1); }
    /// Before `at`, which is an iterator of its own.
    void insert(const T* at, T x) {
        const std::ptrdiff_t k = at - begin();
        push_back(std::move(x));
        for (T* p = end() - 1; p != begin() + k; --p) std::swap(*p, p[-1]);
    }
    void erase(const T* from, const T* to) {
        if (from == to) return;
        T* kept = begin() + (from - begin());
        for (T* next = begin() + (to - begin()); next != end(); ++next) *kept++ = std::move(*next);
        end_at(kept);
    }
    void erase(const T* at) { erase(at, at + 1); }

    /// Takes out the items for which `gone(item)` holds, and returns how many they were.
    template <class Gone>
    std::size_t erase_if(Gone&& gone) {
        T* kept = begin();
        for (T& x : *this)
            if (!gone(std::as_const(x))) {
                if (kept != &x) *kept = std::move(x);
                ++kept;
            }
        const auto erased = static_cast<std::size_t>(end() - kept);
        end_at(kept);
        return erased;
    }
    friend bool operator==(const Column& a, const Column& b) {
        bool equal = a.size() == b.size();
        for (std::size_t i = 0; equal && i < a.size(); ++i) equal = a.begin()[i] == b.begin()[i];
        return equal;
    }

  private:
    /// Where the standard library checks its own: a tenth of a step's time, or two.
    void check([[maybe_unused]] std::size_t i) const {
#ifdef _GLIBCXX_ASSERTIONS
        TALUS_CHECK(i < size(), "an index below the size");
#endif
    }
    [[gnu::noinline]] void append(const T* from, const T* to) {
        make_room(size() + static_cast<std::size_t>(to - from));
        for (; from != to; ++from, end_ = end() + 1) ::new (end_) T(*from);
    }
    void make_room(std::size_t n) {
        if (n > capacity()) move_to_room_for(n < 2 * size() ? 2 * size() : n);
    }
    [[gnu::noinline, gnu::cold]] void grow() { move_to_room_for(empty() ? 1 : 2 * size()); }
    void move_to_room_for(std::size_t n) {
        if constexpr (std::is_trivially_destructible_v<T>)
            move_bytes(n, sizeof(T), alignof(T));
        else
            move_one_by_one(n);
    }
    [[gnu::noinline]] void move_one_by_one(std::size_t n) {
        T* const place = static_cast<T*>(detail::allocate(n, sizeof(T), alignof(T)));
        T* to = place;
        for (T& x : *this) ::new (static_cast<void*>(to++)) T(std::move(x));
        clear();
        detail::deallocate(begin_, alignof(T));
        begin_ = place;
        end_ = to;
        room_ = place + n;
    }
    void end_at(T* to) {
        if constexpr (std::is_trivially_destructible_v<T>)
            end_ = to;
        else
            while (end() > to) {
                end_ = end() - 1;
                end()->~T();
            }
    }
};

/// One entry for each body.
template <class T>
using PerBody = Column<T>;

}  // namespace talus
