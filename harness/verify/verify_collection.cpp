#include "harness/verify/verify_collection.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/collection/collection_record.h"
#include "harness/verify/checks/checks.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// The faults of a data set, told from the collection's folder.
std::vector<Fault> faults_in(const fs::path& folder, const CollectionEntry& entry,
                             const std::function<void(double)>& on_progress) {
  if (!fs::is_directory(folder / entry.folder))
    return {{entry.folder, "", fmt::format("missing data set: {} lists it", kCollectionFile)}};
  try {
    std::vector<Fault> faults =
        verify_dataset(folder / entry.folder, dataset_reader(entry.format), on_progress).faults;
    for (Fault& fault : faults) fault.file = entry.folder + "/" + fault.file;
    return faults;
  } catch (const std::runtime_error& error) {
    return {{entry.folder, "", error.what()}};
  }
}

}  // namespace

bool is_collection(const fs::path& folder) {
  return fs::exists(folder / kCollectionFile);
}

Verification verify_collection(const fs::path& folder, const std::function<void(double)>& on_progress) {
  const CollectionRecord record = read_collection_record(folder);
  ChecksumResult checksums = check_checksums(folder);
  Verification result = {.format = "collection",
                         .faults = std::move(checksums.faults),
                         .checked = {fmt::format("{} data sets", record.datasets.size()),
                                     fmt::format("{} files by SHA-256", checksums.files)},
                         .cannot = std::move(checksums.cannot),
                         .margins = {}};
  const auto sets = static_cast<double>(record.datasets.size());
  for (std::size_t i = 0; i < record.datasets.size(); ++i) {
    const auto show = [&](double done) { on_progress((static_cast<double>(i) + done) / sets); };
    std::vector<Fault> faults = faults_in(folder, record.datasets[i], show);
    std::ranges::move(faults, std::back_inserter(result.faults));
  }
  leave_out_repeated(result.faults);
  return result;
}

Verification verify_folder(const fs::path& folder, const std::string& format,
                           const std::function<void(double)>& on_progress) {
  if (format.empty() && is_collection(folder)) return verify_collection(folder, on_progress);
  const DatasetReader& reader = format.empty() ? reader_of(folder) : dataset_reader(format);
  return verify_dataset(folder, reader, on_progress);
}

}  // namespace stereobench::harness
