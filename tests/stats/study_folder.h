// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "published_table2.h"

namespace fs = std::filesystem;

inline const std::string log_header =
    "trial\treference\ttest\tdistance\tazimuth_deg\tfirst\tsecond\tresponse\tchosen\t"
    "response_time\tonset_first\tonset_grey\tonset_second\n";

/// A log's line, the reference shown first; answer: 'r' reference, 't' test, 'n' none. With a capital, the
/// reference was shown second.
inline std::string log_line(int trial, char answer, const std::string& test = "ss_full",
                            const std::string& distance = "far", int azimuth_deg = 60) {
    const bool first = answer >= 'a';
    const std::string result = answer == 'r'   ? "1\tts"
                               : answer == 't' ? "2\t" + test
                               : answer == 'R' ? "2\tts"
                               : answer == 'T' ? "1\t" + test
                                               : "n/a\tn/a";
    return fmt::format("{}\tts\t{}\t{}\t{}\t{}\t{}\t{}\t1.5\t0.25\t3.25\t5.25\n", trial, test, distance,
                       azimuth_deg, first ? "ts" : test, first ? test : "ts", result);
}

/// A log with one trial a letter.
inline std::string log_text(const std::string& answers) {
    std::string text = log_header;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        text += log_line(static_cast<int>(i) + 1, answers[i]);
    }
    return text;
}

inline std::string read_file(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// A folder of its own that goes when the test ends.
class StudyFolder {
public:
    StudyFolder() {
        std::string pattern = (fs::temp_directory_path() / "stats-test-XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~StudyFolder() { fs::remove_all(path_); }
    StudyFolder(const StudyFolder&) = delete;
    StudyFolder& operator=(const StudyFolder&) = delete;

    const fs::path& path() const { return path_; }

    fs::path write(const fs::path& name, const std::string& text) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }

    /// A participant's log; run is "" or "_run-02".
    fs::path write_log(const std::string& label, const std::string& text, const std::string& run = "") const {
        return write(fmt::format("sub-{0}/beh/sub-{0}_task-skin2afc{1}_beh.tsv", label, run), text);
    }

    fs::path write_sidecar(const std::string& label, const std::string& json,
                           const std::string& run = "") const {
        return write(fmt::format("sub-{0}/beh/sub-{0}_task-skin2afc{1}_beh.json", label, run), json);
    }

    /// The logs that the published counts imply: 16 participants, every condition in both orders.
    void write_published_logs() const {
        for (int participant = 0; participant < published_participants; ++participant) {
            std::string text = log_header;
            int trial = 0;
            for (const PublishedCell& cell : published_table2) {
                for (int order = 0; order < 2; ++order) {
                    const bool reference_chosen = 2 * participant + order < cell.reference_chosen;
                    const std::string first = order == 0 ? "ts" : std::string(cell.test);
                    const std::string second = order == 0 ? std::string(cell.test) : "ts";
                    const std::string chosen = reference_chosen ? "ts" : std::string(cell.test);
                    text += fmt::format("{}\tts\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t1.5\t0.25\t3.25\t5.25\n",
                                        ++trial, cell.test, cell.distance, cell.azimuth_deg, first, second,
                                        chosen == first ? 1 : 2, chosen);
                }
            }
            write_log(fmt::format("{:02}", participant + 1), text);
        }
    }

private:
    fs::path path_;
};

/// The message of the exception of that type which the call throws, or what else happened.
template <typename Exception, typename Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const Exception& error) {
        return error.what();
    }
    return "(nothing thrown)";
}
