// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace cambium::detail {

/// A priority queue of numbered keys in a known range, smallest first, equal keys by number: buckets of keys, of which
/// only the one at the front is a heap, so that what is compared stays in cache. Same order as one heap of all.
template <class T>
class BucketHeap {
 public:
  struct Entry {
    T key;
    std::int32_t number;
    friend bool operator>(const Entry& a, const Entry& b) {
      return a.key > b.key || (a.key == b.key && a.number > b.number);
    }
  };

  /// Empties the queue; keys will be in [0, most). The memory of buckets is kept.
  void reset(T most, T bucket_width) {
    inverse_ = T(1) / bucket_width;
    bucket_.resize(static_cast<std::size_t>(most * inverse_) + 1);
    for (auto& bucket : bucket_) bucket.clear();
    front_ = 0;
  }
  void push(T key, std::int32_t number) {
    const auto k = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(key * inverse_));
    auto& bucket = bucket_[std::max(k, front_)];
    bucket.push_back({key, number});
    if (k <= front_) std::push_heap(bucket.begin(), bucket.end(), std::greater<>{});
  }
  /// Takes the first entry for which valid(entry) is true out, and drops the others before it. \return false if there
  /// is none
  template <class Valid>
  bool pop(Entry& entry, Valid&& valid) {
    for (;;) {
      while (bucket_[front_].empty()) {
        if (++front_ == bucket_.size()) {
          front_ = 0;
          return false;
        }
        auto& bucket = bucket_[front_];
        std::erase_if(bucket, [&](const Entry& candidate) { return !valid(candidate); });
        std::make_heap(bucket.begin(), bucket.end(), std::greater<>{});
      }
      auto& bucket = bucket_[front_];
      std::pop_heap(bucket.begin(), bucket.end(), std::greater<>{});
      entry = bucket.back();
      bucket.pop_back();
      if (valid(entry)) return true;
    }
  }

 private:
  T inverse_{};
  std::size_t front_ = 0;
  std::vector<std::vector<Entry>> bucket_;
};

}  // namespace cambium::detail
