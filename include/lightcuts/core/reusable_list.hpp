#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assertion.hpp"

namespace lightcuts {

/// A list that grows at its end, keeps its storage when it is cleared, and initializes nothing twice: what `append`
/// returns has whatever value stood there before, and has to be assigned. `T` has a default and can be copied.
template <class T>
class ReusableList {
public:
    /// Appends an element of unspecified value and returns it, to be filled in place. References to other elements stay
    /// valid if room was made. cost: amortized constant.
    T& append() {
        if (size_ == capacity_) [[unlikely]]
            grow(size_ + 1);
        return values_[size_++];
    }
    /// Appends a copy of `value`, which must not lie in this list unless room was made.
    void append(const T& value) { append() = value; }

    /// Makes room for `count` elements in all: appending up to there moves none.
    void reserve(std::size_t count) {
        if (count > capacity_) grow(count);
    }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    std::size_t capacity() const { return capacity_; }
    void clear() { size_ = 0; }
    void pop_back() {
        LIGHTCUTS_ASSERT(size_ > 0);
        --size_;
    }

    /// pre: i < size().
    T& operator[](std::size_t i) { return values_[i]; }
    const T& operator[](std::size_t i) const { return values_[i]; }
    T* data() { return values_.data(); }
    const T* data() const { return values_.data(); }

private:
    // Apart, so that `append` is short where it is inlined.
    [[gnu::noinline]] void grow(std::size_t count) {
        values_.resize(count > 2 * capacity_ ? count : 2 * capacity_);
        capacity_ = values_.size();
    }

    std::vector<T> values_;  ///< those behind the first `size_` are storage
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;  ///< values_.size(), which is a division
};

}  // namespace lightcuts
