#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "recording.hpp"
#include "suite.hpp"

namespace {

using nlohmann::json;
using Options = std::map<std::string, std::string>;

constexpr const char* kUsage =
    "blind_generate (--suite small|full|varied|dev_rich|dev_production | --class CLASS [--set "
    "rich|production]\n"
    "                [--effect NAME] [--ratio R] [--count N]) [--seed S] [--only INDEX] --out DIR --labels "
    "FILE\n"
    "blind_generate --suite NAME [--seed S] --count-only      number of trials\n"
    "CLASS: none parameters single pair unknown leave_one_out\n";

Options parse(int count, char** words) {
  Options options;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    if (word.rfind("--", 0) != 0) throw std::invalid_argument("unexpected word " + word);
    const bool has_value = word != "--count-only" && word != "--help";
    if (has_value && k + 1 >= count) throw std::invalid_argument(word + " needs a value");
    options[word.substr(2)] = has_value ? words[++k] : "";
  }
  return options;
}

std::string get(const Options& options, const std::string& key, const std::string& fallback) {
  const auto found = options.find(key);
  return found == options.end() ? fallback : found->second;
}

std::vector<blind::TrialSpec> planned(const Options& o) {
  const std::uint64_t seed = std::stoull(get(o, "seed", "1"));
  if (o.count("suite")) return blind::suite(o.at("suite"), seed);
  return blind::trials_of_class(get(o, "set", "rich"), get(o, "class", "single"), get(o, "effect", ""),
                                std::stod(get(o, "ratio", "0")), std::stoi(get(o, "count", "1")), seed);
}

std::string trial_id(std::size_t index) {
  char id[32];
  std::snprintf(id, sizeof id, "trial_%04zu", index);
  return id;
}

void append_label(const std::string& path, const json& label) {
  json labels = json::array();
  if (std::ifstream file(path); file) labels = json::parse(file);
  labels.push_back(label);
  blind::write_text(path + ".new", labels.dump(1) + "\n");
  std::filesystem::rename(path + ".new", path);
}

void generate(const Options& o, const std::vector<blind::TrialSpec>& trials) {
  if (!o.count("out") || !o.count("labels")) throw std::invalid_argument("--out and --labels are needed");
  const bool is_one = o.count("only") > 0;
  const std::size_t first = is_one ? std::stoull(o.at("only")) : 0;
  const std::size_t end = is_one ? first + 1 : trials.size();
  if (end > trials.size()) throw std::invalid_argument("--only is beyond the last trial");
  for (std::size_t k = first; k < end; ++k) {
    const std::string id = trial_id(k);
    append_label(o.at("labels"), blind::make_trial(trials[k], id, o.at("out") + "/" + id));
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    const Options options = parse(count, words);
    if (options.empty() || options.count("help")) return std::fputs(kUsage, stdout) < 0;
    const auto trials = planned(options);
    if (options.count("count-only")) return std::printf("%zu\n", trials.size()) < 0;
    generate(options, trials);
    return 0;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "blind_generate: %s\n%s", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "blind_generate: %s\n", error.what());
    return 1;
  }
}
