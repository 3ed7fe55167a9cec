#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

namespace icome::base {

/// A list that lies in blocks of 64 items, which its changed copies share: the cost of changing a few items
/// depends on the blocks that they are in, not on the list. Immutable; any number of threads may read one.
template <typename Item>
class SharedBlocks {
 public:
  static constexpr std::size_t kBlockItems = 64;

  SharedBlocks() = default;
  explicit SharedBlocks(std::vector<Item> items) : size_(items.size()) {
    blocks_.reserve((size_ + kBlockItems - 1) / kBlockItems);
    for (std::size_t first = 0; first < size_; first += kBlockItems) {
      const std::size_t count = std::min(kBlockItems, size_ - first);
      Block block = std::make_shared<Item[]>(count);
      std::move(items.begin() + std::ptrdiff_t(first), items.begin() + std::ptrdiff_t(first + count),
                block.get());
      blocks_.push_back(std::move(block));
    }
  }

  /// Real-time safe.
  std::size_t size() const { return size_; }
  /// Real-time safe.
  bool empty() const { return size_ == 0; }
  /// Item `i` < size(). Real-time safe.
  const Item& operator[](std::size_t i) const { return blocks_[i / kBlockItems].get()[i % kBlockItems]; }

  std::size_t block_count() const { return blocks_.size(); }
  /// The items of one block.
  std::span<const Item> block(std::size_t which) const {
    return {blocks_[which].get(), std::min(kBlockItems, size_ - which * kBlockItems)};
  }
  /// Are these the very same items, in memory once?
  bool shares_block(const SharedBlocks& other, std::size_t which) const {
    return which < other.blocks_.size() && blocks_[which] == other.blocks_[which];
  }

  /// This list after `change(k, item)` for item `ascending[k]` of each k; an index may come more than once.
  template <typename Change>
  SharedBlocks changed(std::span<const std::uint32_t> ascending, Change&& change) const {
    SharedBlocks result(*this);
    Item* items = nullptr;
    std::size_t owned = blocks_.size();  // the block that is the result's own; none yet
    for (std::size_t k = 0; k < ascending.size(); ++k) {
      const std::size_t which = ascending[k] / kBlockItems;
      if (which != owned) {
        items = result.own(which);
        owned = which;
      }
      change(k, items[ascending[k] % kBlockItems]);
    }
    return result;
  }

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Item;
    using difference_type = std::ptrdiff_t;
    using pointer = const Item*;
    using reference = const Item&;

    Iterator() = default;
    Iterator(const SharedBlocks* list, std::size_t at) : list_(list), at_(at) {}
    reference operator*() const { return (*list_)[at_]; }
    pointer operator->() const { return &(*list_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) { return {list_, at_++}; }
    bool operator==(const Iterator&) const = default;

   private:
    const SharedBlocks* list_ = nullptr;
    std::size_t at_ = 0;
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size_}; }

  /// Memory (bytes) of the list by itself, as if it shared nothing.
  std::size_t bytes() const { return size_ * sizeof(Item) + blocks_.capacity() * sizeof(Block); }

 private:
  using Block = std::shared_ptr<Item[]>;

  /// Replaces a block, which other lists may share, by a copy of this list's own; returns its items.
  Item* own(std::size_t which) {
    const std::span<const Item> from = block(which);
    Block copy = std::make_shared<Item[]>(from.size());
    std::copy(from.begin(), from.end(), copy.get());
    blocks_[which] = std::move(copy);
    return blocks_[which].get();
  }

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace icome::base
