// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "virtual_screen.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fixture {
namespace {

// An XWD file (XWDFile.h of the X Window System): big-endian words, colour map entries of 12 bytes, then
// pixels.
constexpr std::size_t header_words = 25;
enum Word : std::size_t { header_size = 0, bytes_per_line = 12, colors = 19 };
constexpr std::size_t color_bytes = 12;

/// Where the pixels are.
class Layout {
public:
    explicit Layout(std::istream& file) {
        std::array<std::size_t, header_words> header{};
        for (std::size_t& word : header) {
            unsigned char bytes[4]{};
            file.read(reinterpret_cast<char*>(bytes), 4);
            word = std::size_t{bytes[0]} << 24 | std::size_t{bytes[1]} << 16 | std::size_t{bytes[2]} << 8 |
                   bytes[3];
        }
        first_ = header[header_size] + color_bytes * header[colors];
        line_ = header[bytes_per_line];
    }
    std::streamoff place(int x, int y) const {
        return static_cast<std::streamoff>(first_ + static_cast<std::size_t>(y) * line_ +
                                           4 * static_cast<std::size_t>(x));
    }

private:
    std::size_t first_ = 0, line_ = 0;
};

pid_t start(const std::vector<std::string>& words) {
    std::vector<std::string> copy = words;
    std::vector<char*> argv;
    for (std::string& word : copy) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        const int null = ::open("/dev/null", O_WRONLY);
        ::dup2(null, STDERR_FILENO);
        ::execvp(argv[0], argv.data());
        ::_exit(127);
    }
    return child;
}

void xdotool(std::vector<std::string> words) {
    int status = 1;
    words.insert(words.begin(), "xdotool");
    ::waitpid(start(words), &status, 0);
    if (status != 0) {
        throw std::runtime_error("xdotool failed or is not installed");
    }
}

/// A connection to the server and the program's window there.
struct Client {
    Client() : display(::XOpenDisplay(nullptr)) {
        ::Window root = 0;
        ::Window parent = 0;
        ::Window* children = nullptr;
        unsigned count = 0;
        ::XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
        for (unsigned i = 0; i < count; ++i) {
            char* name = nullptr;
            if (::XFetchName(display, children[i], &name) != 0 && std::string(name) == "skin2afc") {
                window = children[i];
            }
            ::XFree(name);
        }
        ::XFree(children);
    }
    ~Client() { ::XCloseDisplay(display); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    ::Display* display;
    ::Window window = 0;
};

} // namespace

VirtualScreen::VirtualScreen(const std::filesystem::path& folder, int width, int height)
    : framebuffer_(folder / "Xvfb_screen0"), width_(width), height_(height) {
    // Let the server choose a free display and tell its number through a pipe when it is ready.
    int ends[2];
    if (::pipe(ends) != 0) {
        throw std::runtime_error("no pipe");
    }
    server_ = start({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0",
                     fmt::format("{}x{}x24", width, height), "-fbdir", folder.string(), "-nolisten", "tcp",
                     "-noreset"});
    ::close(ends[1]);
    std::string display;
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) {
        display += c;
    }
    ::close(ends[0]);
    if (display.empty()) {
        ::waitpid(server_, nullptr, 0);
        throw std::runtime_error("Xvfb does not start or is not installed");
    }
    ::setenv("DISPLAY", (":" + display).c_str(), 1);
}

VirtualScreen::~VirtualScreen() {
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
}

std::array<std::uint8_t, 3> VirtualScreen::pixel(int x, int y) const {
    std::ifstream file(framebuffer_, std::ios::binary);
    const Layout layout(file);
    file.seekg(layout.place(x, y));
    unsigned char bgrx[4]{};
    file.read(reinterpret_cast<char*>(bgrx), 4);
    return {bgrx[2], bgrx[1], bgrx[0]};
}

bool VirtualScreen::becomes(int x, int y, const std::array<std::uint8_t, 3>& rgb) const {
    for (int look = 0; look < 10000; ++look) {
        if (pixel(x, y) == rgb) {
            return true;
        }
        ::usleep(2000);
    }
    return false;
}

void VirtualScreen::key(const std::string& name) { xdotool({"key", name}); }
void VirtualScreen::key_down(const std::string& name) { xdotool({"keydown", name}); }
void VirtualScreen::key_up(const std::string& name) { xdotool({"keyup", name}); }

void VirtualScreen::act(const std::vector<std::string>& words) { xdotool(words); }

void VirtualScreen::ask_to_close() {
    const Client client;
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = client.window;
    event.xclient.message_type = ::XInternAtom(client.display, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(::XInternAtom(client.display, "WM_DELETE_WINDOW", False));
    ::XSendEvent(client.display, client.window, False, NoEventMask, &event);
    ::XSync(client.display, False);
}

void VirtualScreen::focus(bool window) {
    const Client client;
    ::XSetInputFocus(client.display, window ? client.window : DefaultRootWindow(client.display), RevertToNone,
                     CurrentTime);
    ::XSync(client.display, False);
}

bool VirtualScreen::save(const std::filesystem::path& png) const {
    std::ifstream file(framebuffer_, std::ios::binary);
    const Layout layout(file);
    std::vector<std::uint8_t> pixels;
    std::vector<char> row(4 * static_cast<std::size_t>(width_));
    for (int y = 0; y < height_; ++y) {
        file.seekg(layout.place(0, y));
        file.read(row.data(), static_cast<std::streamsize>(row.size()));
        for (std::size_t i = 0; i < row.size(); i += 4) {
            for (const std::size_t channel : {2U, 1U, 0U}) {
                pixels.push_back(static_cast<std::uint8_t>(row[i + channel]));
            }
        }
    }
    const auto output = OIIO::ImageOutput::create("png");
    output->open(png.string(), OIIO::ImageSpec(width_, height_, 3, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, pixels.data());
    output->close();
    return std::search_n(pixels.begin(), pixels.end(), static_cast<std::ptrdiff_t>(pixels.size()),
                         pixels.front()) == pixels.end();
}

} // namespace fixture
