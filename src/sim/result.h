// A value or the reason why there is none; sim and model return it at their borders.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace windfall {

/// One clear line: what is wrong, and where ("branch 3 of birch.fbx: …"). The file's name is added by who reports it.
struct Error {
  std::string message;
  bool cancelled = false;
};

/// Holds a T or an Error. `T` may be std::monostate where only success counts.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : data_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : data_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return data_.index() == 0; }
  T& operator*() { return std::get<0>(data_); }
  const T& operator*() const { return std::get<0>(data_); }
  T* operator->() { return &std::get<0>(data_); }
  const T* operator->() const { return &std::get<0>(data_); }
  /// The error; call only when there is no value.
  const Error& error() const { return std::get<1>(data_); }

 private:
  std::variant<T, Error> data_;
};

using Status = Result<std::monostate>;
inline Status ok() { return std::monostate{}; }

}  // namespace windfall
