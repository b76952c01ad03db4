// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fixture.h"

namespace fixture {

/// A study of twelve trials, run by the program itself.
class ResumeTest : public testing::Test {
protected:
    ResumeTest() : protocol_(small_protocol(folder_.path(), "[0, 30, 60, 90, 120, 150]")) {
        write_stimuli(folder_ / "stimuli", protocol_);
    }

    std::vector<std::string> arguments(const fs::path& study,
                                       const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"session",       protocol_.file.string(),
                                     "--stimuli",     (folder_ / "stimuli").string(),
                                     "--study",       study.string(),
                                     "--participant", "01",
                                     "--simulate",    "null"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Outcome run(const std::vector<std::string>& more = {}) const {
        return run_program(arguments(study(), more));
    }
    fs::path study() const { return folder_ / "study"; }
    fs::path log(int run = 1) const { return log_path(study(), "01", run); }
    fs::path sidecar() const { return log().replace_extension(".json"); }
    nlohmann::json facts() const { return nlohmann::json::parse(read(sidecar())); }

    /// Leave the study as a session does that is cut off after so many trials, with `torn` at the log's end.
    void cut_off_after(std::size_t trials, const std::string& torn = "") const {
        ASSERT_EQ(run().exit_code, 0);
        const auto lines = lines_of(log());
        std::string kept;
        for (std::size_t i = 0; i <= trials; ++i) {
            kept += lines[i] + "\n";
        }
        write(log(), kept + torn);
    }

    /// What a session decides and a participant answers; times differ between a session and its continuation.
    static std::vector<std::vector<std::string>> answers(const fs::path& log) {
        std::vector<std::vector<std::string>> rows;
        for (const auto& row : read_log(log)) {
            rows.push_back({row.at("trial"), row.at("first"), row.at("second"), row.at("azimuth_deg"),
                            row.at("response"), row.at("response_time")});
        }
        return rows;
    }

    TemporaryFolder folder_;
    study::Protocol protocol_;
};

} // namespace fixture
