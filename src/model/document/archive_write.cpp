#include <zip.h>

#include "model/document/archive.h"

namespace windfall::model {

namespace {

// 1 January 1980, midnight: the first date a zip can hold; libzip turns it through local time and back.
constexpr zip_uint16_t kDosTime = 0, kDosDate = (0 << 9) | (1 << 5) | 1;
constexpr zip_uint32_t kRegularFile = 0100644;
constexpr int kLevel = 6;

struct Packing {
  zip_t* zip = nullptr;
  zip_source_t* target = nullptr;
  ~Packing() {
    if (zip) zip_discard(zip);
    if (target) zip_source_free(target);
  }
};

Error failure(const char* reason) { return Error{std::string("cannot be packed: ") + reason}; }

}  // namespace

Result<QByteArray> packArchive(const std::vector<ArchiveEntry>& entries, Progress& progress) {
  zip_error_t error;
  zip_error_init(&error);
  Packing packing;
  packing.target = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (!packing.target) return failure(zip_error_strerror(&error));
  zip_source_keep(packing.target);
  packing.zip = zip_open_from_source(packing.target, ZIP_CREATE | ZIP_TRUNCATE, &error);
  if (!packing.zip) return failure(zip_error_strerror(&error));

  for (const ArchiveEntry& entry : entries) {
    const auto length = static_cast<zip_uint64_t>(entry.bytes.size());
    zip_source_t* source = zip_source_buffer(packing.zip, entry.bytes.constData(), length, 0);
    if (!source) return failure(zip_strerror(packing.zip));
    const zip_int64_t place = zip_file_add(packing.zip, entry.name.toUtf8().constData(), source, ZIP_FL_ENC_UTF_8);
    if (place < 0) {
      zip_source_free(source);
      return failure(zip_strerror(packing.zip));
    }
    const auto index = static_cast<zip_uint64_t>(place);
    const bool store = entry.store || entry.bytes.isEmpty();
    if (zip_set_file_compression(packing.zip, index, store ? ZIP_CM_STORE : ZIP_CM_DEFLATE, store ? 0 : kLevel) != 0 ||
        zip_file_set_dostime(packing.zip, index, kDosTime, kDosDate, 0) != 0 ||
        zip_file_set_external_attributes(packing.zip, index, 0, ZIP_OPSYS_UNIX, kRegularFile << 16) != 0) {
      return failure(zip_strerror(packing.zip));
    }
  }
  zip_register_cancel_callback_with_state(
      packing.zip, [](zip_t*, void* state) { return static_cast<Progress*>(state)->cancelled() ? 1 : 0; }, nullptr,
      &progress);
  if (zip_close(packing.zip) != 0) {
    if (progress.cancelled()) return Error{"cancelled", true};
    return failure(zip_strerror(packing.zip));
  }
  packing.zip = nullptr;

  zip_stat_t stat;
  if (zip_source_stat(packing.target, &stat) != 0 || zip_source_open(packing.target) != 0) {
    return failure(zip_error_strerror(zip_source_error(packing.target)));
  }
  QByteArray bytes(static_cast<qsizetype>(stat.size), Qt::Uninitialized);
  const zip_int64_t got = zip_source_read(packing.target, bytes.data(), stat.size);
  zip_source_close(packing.target);
  if (got != static_cast<zip_int64_t>(stat.size)) return failure("the packed bytes cannot be read back");
  return bytes;
}

}  // namespace windfall::model
