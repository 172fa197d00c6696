// Device memory with an owner, and CUDA errors as one line.
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <span>
#include <string>

namespace windfall::cuda {

/// Keeps the first error.
class Outcome {
 public:
  /// True while nothing has failed; `what` names the call for the user.
  bool check(cudaError_t error, const char* what) {
    if (error != cudaSuccess && problem_.empty())
      problem_ = std::string("CUDA: ") + what + ": " + cudaGetErrorString(error);
    return problem_.empty();
  }
  bool good() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }

 private:
  std::string problem_;
};

/// An array in device memory; taken once.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { cudaFree(data_); }

  void allocate(std::size_t count, Outcome& outcome) {
    void* memory = nullptr;
    if (!outcome.good()) return;
    if (!outcome.check(cudaMalloc(&memory, (count > 0 ? count : 1) * sizeof(T)), "memory of the device")) return;
    data_ = static_cast<T*>(memory);
    count_ = count;
  }
  void write(std::span<const T> from, Outcome& outcome) {
    if (!outcome.good() || from.size() > count_ || from.empty()) return;
    outcome.check(cudaMemcpyAsync(data_, from.data(), from.size_bytes(), cudaMemcpyHostToDevice), "copy to the device");
  }
  void read(std::span<T> to, Outcome& outcome) const {
    if (!outcome.good() || to.size() > count_ || to.empty()) return;
    outcome.check(cudaMemcpyAsync(to.data(), data_, to.size_bytes(), cudaMemcpyDeviceToHost), "copy from the device");
  }
  T* data() const { return data_; }
  void swap(Buffer& other) {
    std::swap(data_, other.data_);
    std::swap(count_, other.count_);
  }

 private:
  T* data_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace windfall::cuda
