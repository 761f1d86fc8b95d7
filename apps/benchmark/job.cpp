// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/job.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/benchmark/foreign_text.hpp"
#include "apps/command/json_text.hpp"
#include "odosplat/core/checksum.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {

void check_job_id(const std::string& id) {
  std::size_t start = 0;
  bool plain = true;
  for (std::size_t end = 0; plain && end != std::string::npos; start = end + 1) {
    end = id.find('/', start);
    const std::string word = id.substr(start, end == std::string::npos ? end : end - start);
    plain = !word.empty() && word != "." && word != ".." && std::all_of(word.begin(), word.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
             c == '-';
    });
  }
  if (!plain) {
    throw InputError("job " + clean_text(id), "an id is of letters, digits, ., _ and -, in words with / between them");
  }
}

std::vector<std::string> fingerprints(const std::vector<Job>& jobs) {
  std::vector<std::string> all;
  std::map<std::string, std::string> by_id;
  for (const Job& job : jobs) {
    check_job_id(job.id);
    Checksum sum;
    sum.add(ODOSPLAT_VERSION);
    for (const std::string& word : job.command) {
      sum.add(word);
      sum.add(std::string_view("\0", 1));  // a separator: "a" "bc" must not hash as "ab" "c"
    }
    for (const std::string& need : job.needs) {
      const auto found = by_id.find(need);
      if (found == by_id.end()) throw std::logic_error(job.id + " needs " + need + ", which is not in front of it");
      sum.add(found->second);
    }
    all.push_back(sum.text());
    by_id[job.id] = all.back();
  }
  return all;
}

std::string record_file(const std::string& out, const std::string& id) { return out + "/jobs/" + id + "/record.json"; }
std::string log_file(const std::string& out, const std::string& id) { return out + "/jobs/" + id + "/log.txt"; }

JobRecord read_record(const std::string& out, const std::string& id) {
  JobRecord record;
  try {
    const auto json = nlohmann::json::parse(read_file(record_file(out, id)));
    record.fingerprint = json.at("fingerprint").get<std::string>();
    record.fault = json.at("fault").get<std::string>();
    record.seconds = json.at("seconds").get<double>();
    record.peak_memory_mb = json.at("peak_memory_mb").get<double>();
    record.id = id;
  } catch (const InputError&) {
    return {};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return record;
}

void write_record(const std::string& out, const JobRecord& record) {
  const nlohmann::ordered_json json{{"id", record.id},
                                    {"fingerprint", record.fingerprint},
                                    {"fault", record.fault},
                                    {"seconds", record.seconds},
                                    {"peak_memory_mb", record.peak_memory_mb}};
  write_file_atomically(record_file(out, record.id), json_text(json));
}

}  // namespace odosplat::apps
