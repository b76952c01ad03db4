// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "study_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <support/error.h>
#include <support/file.h>
#include <support/json_depth.h>

#include "durable_file.h"

namespace experiment {
namespace {

using nlohmann::ordered_json;
using support::failure;
using support::input_error;

constexpr std::size_t longest_label = 64;
constexpr const char* bids_version = "1.11.0";

/// A file held open under an exclusive lock, which other programs wait for.
class LockedFile {
public:
    explicit LockedFile(const fs::path& path)
        : fd_(::open(path.c_str(), O_CREAT | O_RDWR | O_APPEND | O_CLOEXEC, 0644)) {
        if (fd_ < 0 || ::flock(fd_, LOCK_EX) != 0) {
            const int error = errno;
            if (fd_ >= 0) {
                ::close(fd_);
            }
            throw failure("{}: cannot be opened and locked: {}", path.string(), std::strerror(error));
        }
    }
    ~LockedFile() { ::close(fd_); }
    LockedFile(const LockedFile&) = delete;
    LockedFile& operator=(const LockedFile&) = delete;
    int fd() const { return fd_; }

private:
    int fd_;
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        lines.push_back(line);
    }
    return lines;
}

std::string first_column(const std::string& line) { return line.substr(0, line.find('\t')); }

/// Whether a study folder without description holds participants' data.
bool holds_data(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().filename().string().starts_with("sub-")) {
            return true;
        }
    }
    return false;
}

ordered_json description(const std::string& title, const std::string& protocol, bool simulated) {
    ordered_json generator{{"Name", "skin2afc"}, {"Version", SKIN2AFC_VERSION}};
    if (simulated) {
        generator["Description"] = "Simulated participants; no person took part";
    }
    return {{"Name", title + (simulated ? " (simulated)" : "")},
            {"BIDSVersion", bids_version},
            {"DatasetType", "raw"},
            {"GeneratedBy", ordered_json::array({generator})},
            {"Protocol", protocol},
            {"Simulated", simulated}};
}

void write_if_absent(const fs::path& path, const ordered_json& content) {
    if (!fs::exists(path)) {
        support::write_atomically(path, content.dump(2) + "\n");
    }
}

} // namespace

void check_label(const std::string& label) {
    const auto allowed = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    if (label.empty() || label.size() > longest_label || !std::all_of(label.begin(), label.end(), allowed)) {
        throw input_error(
            "--participant: expected 1 to {} letters and digits (without \"sub-\"), found \"{}\"",
            longest_label, support::one_line(label.substr(0, 2 * longest_label)));
    }
}

StudyFolder::StudyFolder(fs::path folder, bool simulated, std::string protocol)
    : folder_(std::move(folder)), simulated_(simulated), protocol_(std::move(protocol)) {
    check_kind();
    check_participants();
}

/// Refuse a table of participants that another program keeps in another form.
void StudyFolder::check_participants() const {
    const fs::path path = folder_ / "participants.tsv";
    if (!fs::exists(path)) {
        return;
    }
    const auto lines = lines_of(support::read_text(path));
    if (!lines.empty() && first_column(lines.front()) != "participant_id") {
        throw input_error("{}:1: expected \"participant_id\" as the first column, found \"{}\"",
                          path.string(), support::one_line(first_column(lines.front())).substr(0, 60));
    }
}

/// Keep simulated participants and people apart.
void StudyFolder::check_kind() const {
    const fs::path path = folder_ / "dataset_description.json";
    bool holds_simulated = false;
    if (fs::exists(path)) {
        const std::string text = support::read_text(path);
        support::check_json_depth(text, path.string());
        const auto content = nlohmann::json::parse(text, nullptr, false);
        if (!content.is_object()) {
            throw input_error("{}: expected a JSON object, found something else or a truncated file",
                              path.string());
        }
        const auto field = content.find("Simulated");
        if (field != content.end() && !field->is_boolean()) {
            throw input_error("{}: Simulated: expected true or false, found a {}", path.string(),
                              field->type_name());
        }
        holds_simulated = field != content.end() && field->get<bool>();
        const auto held = content.find("Protocol");
        if (held != content.end() && held->is_string() && held->get<std::string>() != protocol_) {
            throw input_error(
                "{}: expected a study of the protocol {}, found one of {}; give --study another folder",
                folder_.string(), protocol_, support::one_line(held->get<std::string>()));
        }
    } else if (!holds_data(folder_)) {
        return;
    }
    if (holds_simulated != simulated_) {
        throw input_error(
            "{}: expected a study of {} participants, found one of {}; give --study another folder",
            folder_.string(), simulated_ ? "simulated" : "real",
            holds_simulated ? "simulated ones" : "real ones");
    }
}

void StudyFolder::prepare(const std::string& title, const std::string& label) const {
    support::make_writable_folder(folder_);
    const LockedFile participants(folder_ / "participants.tsv");
    check_kind();
    check_participants();
    write_if_absent(folder_ / "dataset_description.json", description(title, protocol_, simulated_));
    write_if_absent(folder_ / "participants.json",
                    {{"participant_id", {{"Description", "One participant, named by the experimenter"}}}});
    note_participant(participants.fd(), label);
}

/// Append the participant's row to participants.tsv unless it is there; rows and columns that others wrote
/// stay.
void StudyFolder::note_participant(int fd, const std::string& label) const {
    const fs::path path = folder_ / "participants.tsv";
    const std::string text = support::read_text(path);
    const auto lines = lines_of(text);
    const std::string id = "sub-" + label;
    if (std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return first_column(line) == id; })) {
        return;
    }
    std::string addition = lines.empty() ? "participant_id\n" : text.back() == '\n' ? "" : "\n";
    addition += id;
    const auto further = lines.empty() ? 0 : std::count(lines.front().begin(), lines.front().end(), '\t');
    for (std::ptrdiff_t i = 0; i < further; ++i) {
        addition += "\tn/a";
    }
    addition += '\n';
    const auto size = static_cast<ssize_t>(addition.size());
    if (::write(fd, addition.data(), addition.size()) != size || ::fsync(fd) != 0) {
        const int error = errno;
        const bool whole = ::ftruncate(fd, static_cast<off_t>(text.size())) == 0;
        throw failure("{}: cannot be written: {}{}", path.string(), std::strerror(error),
                      whole ? "" : "; its last line may be torn");
    }
}

void StudyFolder::keep_contact_sheet(const fs::path& sheet) const {
    const fs::path kept = folder_ / "stimuli" / "contact_sheet.png";
    if (!fs::is_regular_file(sheet) || fs::exists(kept)) {
        return;
    }
    support::make_writable_folder(kept.parent_path());
    support::PendingFile pending(kept);
    fs::copy_file(sheet, pending.path(), fs::copy_options::overwrite_existing);
    pending.commit();
}

} // namespace experiment
