//! A headless Chromium, driven by the DevTools protocol over a WebSocket (RFC 6455).
//!
//! Only what the tests need: one page, expressions evaluated in it, the mouse, and everything the
//! page complained about or asked for.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::{Duration, Instant};

use serde_json::{json, Value};

/// Where to look, in this order, unless the environment variable `CHROMIUM` says.
const NAMES: [&str; 6] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
];

const FLAGS: [&str; 12] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--no-default-browser-check",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-port=0",
    "about:blank",
];

/// The program, or a failure that says how to get it.
fn program() -> PathBuf {
    if let Some(path) = std::env::var_os("CHROMIUM") {
        return path.into();
    }
    let path = std::env::var_os("PATH").unwrap_or_default();
    NAMES
        .iter()
        .flat_map(|name| std::env::split_paths(&path).map(move |folder| folder.join(name)))
        .find(|candidate| candidate.is_file())
        .unwrap_or_else(|| {
            panic!(
                "these tests look at the page in Chromium, which is not installed.\n\
                 Install it (Debian, Ubuntu: apt-get install chromium; macOS: brew install --cask \
                 chromium) or set CHROMIUM to a Chrome or Chromium program."
            )
        })
}

/// A browser; it ends with the last page that is open in it.
struct Browser {
    process: Child,
    folder: PathBuf,
    pages: AtomicU32,
}

impl Browser {
    /// The browser that other tests have pages in, or a new one.
    fn shared() -> Arc<Self> {
        static SHARED: Mutex<Weak<Browser>> = Mutex::new(Weak::new());
        let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
        shared.upgrade().unwrap_or_else(|| {
            let browser = Arc::new(Self::start());
            *shared = Arc::downgrade(&browser);
            browser
        })
    }

    fn start() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("chetaev-report-{}-{count}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        let process = Command::new(program())
            .arg(format!("--user-data-dir={}", folder.display()))
            .args(FLAGS)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        Self {
            process,
            folder,
            pages: AtomicU32::new(0),
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // The tests are over; what fails here leaves at most a folder behind.
        let _ = self.process.kill();
        let _ = self.process.wait();
        for _ in 0..20 {
            if std::fs::remove_dir_all(&self.folder).is_ok() {
                break;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

/// An open page, with a connection of its own.
pub(crate) struct Page {
    /// Held so that the browser lives as long as the page.
    _browser: Arc<Browser>,
    socket: Socket,
    target: Value,
    session: String,
    next: u64,
    events: Vec<Value>,
    address: String,
}

/// How the page is looked at.
pub(crate) struct View {
    pub(crate) width: u32,
    pub(crate) dark: bool,
    /// The reader prefers stillness: the motion does not start by itself.
    pub(crate) still: bool,
}

impl Default for View {
    fn default() -> Self {
        Self {
            width: 1280,
            dark: false,
            still: true,
        }
    }
}

impl Page {
    /// Shows a page from a file.
    pub(crate) fn open(html: &str, view: &View) -> Self {
        let browser = Browser::shared();
        let count = browser.pages.fetch_add(1, Ordering::Relaxed);
        let file = browser.folder.join(format!("report-{count}.html"));
        std::fs::write(&file, html).unwrap();
        let mut page = Self {
            address: format!("file://{}", file.display()),
            socket: Socket::connect(&browser.folder),
            _browser: browser,
            target: Value::Null,
            session: String::new(),
            next: 0,
            events: Vec::new(),
        };
        page.load(view);
        page
    }

    fn load(&mut self, view: &View) {
        // A window of its own: a page behind another one would not draw.
        let target = self.send(
            "Target.createTarget",
            json!({"url": "about:blank", "newWindow": true}),
        );
        self.target = target["targetId"].clone();
        let attached = self.send(
            "Target.attachToTarget",
            json!({"targetId": self.target, "flatten": true}),
        );
        self.session = attached["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.send(&format!("{domain}.enable"), json!({}));
        }
        self.send(
            "Emulation.setDeviceMetricsOverride",
            json!({
                "width": view.width, "height": 900, "deviceScaleFactor": 1,
                "mobile": view.width < 500,
            }),
        );
        let scheme = if view.dark { "dark" } else { "light" };
        let motion = if view.still {
            "reduce"
        } else {
            "no-preference"
        };
        self.send(
            "Emulation.setEmulatedMedia",
            json!({"features": [
                {"name": "prefers-color-scheme", "value": scheme},
                {"name": "prefers-reduced-motion", "value": motion},
            ]}),
        );
        let address = self.address.clone();
        self.send("Page.navigate", json!({ "url": address }));
        self.wait_until("document.readyState === 'complete'");
        self.settle();
    }

    /// Lets the page draw.
    pub(crate) fn settle(&mut self) {
        self.evaluate(
            "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50))))",
        );
    }

    /// The value of an expression in the page; a promise is waited for.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let answer = self.send(
            "Runtime.evaluate",
            json!({"expression": expression, "awaitPromise": true, "returnByValue": true}),
        );
        assert!(
            answer.get("exceptionDetails").is_none(),
            "{expression}\n{answer:#}"
        );
        answer["result"]["value"].clone()
    }

    /// A number that the page computes.
    pub(crate) fn number(&mut self, expression: &str) -> f64 {
        let value = self.evaluate(expression);
        value
            .as_f64()
            .unwrap_or_else(|| panic!("{expression} is {value}"))
    }

    /// A text that the page computes.
    pub(crate) fn text(&mut self, expression: &str) -> String {
        let value = self.evaluate(expression);
        value
            .as_str()
            .unwrap_or_else(|| panic!("{expression} is {value}"))
            .to_owned()
    }

    /// Whether something holds in the page.
    pub(crate) fn holds(&mut self, expression: &str) -> bool {
        self.evaluate(expression) == Value::Bool(true)
    }

    /// Waits until something holds in the page.
    pub(crate) fn wait_until(&mut self, expression: &str) {
        let start = Instant::now();
        while !self.holds(expression) {
            assert!(
                start.elapsed() < Duration::from_secs(60),
                "not within a minute: {expression}"
            );
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Moves the mouse to a point of an element, given by fractions of its width and height, and
    /// does something there: `mousePressed`, `mouseReleased` or `mouseMoved`.
    pub(crate) fn mouse(&mut self, kind: &str, selector: &str, at: [f64; 2], clicks: u32) {
        let frame = self.evaluate(&format!(
            "(() => {{ const r = document.querySelector({selector:?}).getBoundingClientRect();
                       return [r.x, r.y, r.width, r.height]; }})()"
        ));
        let frame: Vec<f64> = serde_json::from_value(frame).unwrap();
        let button = if kind == "mouseMoved" { "none" } else { "left" };
        self.send(
            "Input.dispatchMouseEvent",
            json!({
                "type": kind, "button": button, "clickCount": clicks,
                "x": frame[0] + at[0] * frame[2], "y": frame[1] + at[1] * frame[3],
            }),
        );
    }

    /// Presses at one point of an element and releases at another.
    pub(crate) fn drag(&mut self, selector: &str, from: [f64; 2], to: [f64; 2]) {
        self.mouse("mouseMoved", selector, from, 0);
        self.mouse("mousePressed", selector, from, 1);
        self.mouse(
            "mouseMoved",
            selector,
            [(from[0] + to[0]) / 2.0, (from[1] + to[1]) / 2.0],
            0,
        );
        self.mouse("mouseMoved", selector, to, 0);
        self.mouse("mouseReleased", selector, to, 1);
    }

    /// The page on paper.
    pub(crate) fn print(&mut self) -> usize {
        let answer = self.send("Page.printToPDF", json!({}));
        answer["data"].as_str().unwrap().len()
    }

    /// Errors, warnings and violations the page caused, and requests to anything but itself.
    pub(crate) fn complaints(&mut self) -> Vec<String> {
        // An answer to this comes after every event that went before.
        self.evaluate("0");
        self.events
            .iter()
            .filter_map(|event| complaint(event, &self.address))
            .collect()
    }

    /// Sends a command and waits for its answer; keeps the events that come before it.
    fn send(&mut self, method: &str, parameters: Value) -> Value {
        self.next += 1;
        let mut message = json!({"id": self.next, "method": method, "params": parameters});
        if !self.session.is_empty() {
            message["sessionId"] = self.session.as_str().into();
        }
        self.socket.write(&message.to_string());
        loop {
            let answer: Value = serde_json::from_str(&self.socket.read()).unwrap();
            if answer["id"] == self.next {
                assert!(answer.get("error").is_none(), "{method}: {answer:#}");
                return answer["result"].clone();
            }
            if answer.get("method").is_some() {
                self.events.push(answer);
            }
        }
    }
}

fn complaint(event: &Value, address: &str) -> Option<String> {
    let parameters = &event["params"];
    match event["method"].as_str()? {
        "Runtime.exceptionThrown" => Some(parameters["exceptionDetails"].to_string()),
        "Runtime.consoleAPICalled" => {
            let kind = parameters["type"].as_str()?;
            ["error", "warning", "assert"]
                .contains(&kind)
                .then(|| parameters["args"].to_string())
        }
        "Log.entryAdded" => Some(parameters["entry"].to_string()),
        "Network.requestWillBeSent" => {
            let to = parameters["request"]["url"].as_str()?;
            let is_own = to == address || to.starts_with("data:");
            (!is_own).then(|| format!("request to {to}"))
        }
        _ => None,
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        // Only asked, not waited for: the connection may be what failed.
        let close =
            json!({"id": 0, "method": "Target.closeTarget", "params": {"targetId": self.target}});
        let _ = self.socket.0.write_all(&frame(&close.to_string()));
        let _ = std::fs::remove_file(self.address.trim_start_matches("file://"));
    }
}

/// A WebSocket to the browser.
struct Socket(TcpStream);

impl Socket {
    /// Connects to the browser that writes its port into a folder.
    fn connect(folder: &Path) -> Self {
        let start = Instant::now();
        let (port, path) = loop {
            let text =
                std::fs::read_to_string(folder.join("DevToolsActivePort")).unwrap_or_default();
            if let Some((port, path)) = text.trim().split_once('\n') {
                break (port.to_owned(), path.trim().to_owned());
            }
            assert!(
                start.elapsed() < Duration::from_secs(60),
                "Chromium ({}) did not start within a minute",
                program().display()
            );
            std::thread::sleep(Duration::from_millis(30));
        };
        let mut stream = TcpStream::connect(format!("127.0.0.1:{port}")).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(60)))
            .unwrap();
        write!(
            stream,
            "GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n\
             Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\
             Sec-WebSocket-Version: 13\r\n\r\n"
        )
        .unwrap();
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).unwrap();
            head.push(byte[0]);
        }
        assert!(head.starts_with(b"HTTP/1.1 101"));
        Self(stream)
    }

    fn write(&mut self, text: &str) {
        self.0.write_all(&frame(text)).unwrap();
    }

    /// The next text message, put together from its frames.
    fn read(&mut self) -> String {
        let mut message = Vec::new();
        loop {
            let mut head = [0; 2];
            self.0.read_exact(&mut head).unwrap();
            let length = match head[1] & 0x7f {
                126 => u64::from(u16::from_be_bytes(self.bytes())),
                127 => u64::from_be_bytes(self.bytes()),
                length => u64::from(length),
            };
            let mut payload = vec![0; usize::try_from(length).unwrap()];
            self.0.read_exact(&mut payload).unwrap();
            let (is_last, opcode) = (head[0] & 0x80 != 0, head[0] & 0x0f);
            // Text and its continuations; pings of the browser need no answer here.
            if opcode <= 1 {
                message.extend(payload);
                if is_last {
                    return String::from_utf8(message).unwrap();
                }
            }
        }
    }

    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        self.0.read_exact(&mut bytes).unwrap();
        bytes
    }
}

/// One text message in one frame; the mask is zero, so that the payload stays as it is.
fn frame(text: &str) -> Vec<u8> {
    let mut frame = vec![0x81];
    match text.len() {
        length @ 0..=125 => frame.push(0x80 | length as u8),
        length @ 126..=65535 => {
            frame.push(0x80 | 126);
            frame.extend((length as u16).to_be_bytes());
        }
        length => {
            frame.push(0x80 | 127);
            frame.extend((length as u64).to_be_bytes());
        }
    }
    frame.extend([0; 4]);
    frame.extend(text.as_bytes());
    frame
}
