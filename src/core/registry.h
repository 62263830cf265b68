// Registry of self-describing things (laws, effects, targets). A file adds one, or a table of them,
// with a file-scope `const Registered<T> registered{make};`; it links because the library is a
// CMake OBJECT library.
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace frictab {

template <class T> const T& registered_item(const T& item) {
  return item;
}
template <class T> const T& registered_item(const std::unique_ptr<T>& item) {
  return *item;
}

// Requires of T: `std::string name` and `int order` (the position in listings). T may also be a
// std::unique_ptr to an interface with these.
template <class T> class Registry {
public:
  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  void add(T item) {
    const auto later = [](const T& left, const T& right) {
      const auto &a = registered_item(left), &b = registered_item(right);
      return a.order != b.order ? a.order < b.order : a.name < b.name;
    };
    items_.insert(std::ranges::upper_bound(items_, item, later), std::move(item));
  }

  // Tables take time to read: they are made once, when somebody first asks for an item.
  void add_table(std::vector<T> (*make)()) { tables_.push_back(make); }

  const std::vector<T>& all() {
    static const bool complete = (add_tables(), true); // T has one registry
    (void)complete;
    return items_;
  }

  const T* find(std::string_view name) {
    for (const T& item : all())
      if (registered_item(item).name == name) return &item;
    return nullptr;
  }

private:
  void add_tables() {
    for (const auto make : tables_)
      for (T& item : make())
        add(std::move(item));
  }

  std::vector<T> items_;
  std::vector<std::vector<T> (*)()> tables_;
};

template <class T> struct Registered {
  explicit Registered(T (*make)()) { Registry<T>::instance().add(make()); }
  explicit Registered(std::vector<T> (*make)()) { Registry<T>::instance().add_table(make); }
};

} // namespace frictab
