//! Headless Chromium, driven over two pipes by the Chrome DevTools protocol: JSON messages that end
//! in a zero byte, without sockets or libraries.

use std::env;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use serde_json::{Value as Json, json};
use tempfile::TempDir;

/// Maximum duration of any operation, even on a busy machine.
const PATIENCE: Duration = Duration::from_secs(90);

/// Browser with one page.
pub struct Browser {
    child: Child,
    to: ChildStdin,
    from: Receiver<Json>,
    last: u64,
    session: Option<String>,
    /// Unsolicited events of the page, in order: requests, messages, faults.
    pub events: Vec<Json>,
    _profile: TempDir,
}

impl Browser {
    /// Starts the program named by `PUSHPLAN_CHROMIUM`, otherwise `chromium`. Returns `None` if
    /// there is none, which is a fault in CI.
    pub fn start() -> Option<Self> {
        Self::start_with(&["--disable-gpu"])
    }

    /// Starts the browser with these options.
    pub fn start_with(options: &[&str]) -> Option<Self> {
        let named = env::var("PUSHPLAN_CHROMIUM").unwrap_or_else(|_| "chromium".to_owned());
        if Command::new(&named).arg("--version").output().is_err() {
            let strict = env::var("CI").is_ok_and(|ci| ci == "true") && named != "none";
            assert!(!strict, "there is no `{named}`, and a server must have one");
            eprintln!("SKIPPED: there is no `{named}`, so that the plan page is not opened");
            return None;
        }
        let profile = TempDir::new().expect("a folder");
        // The browser reads from its file 3 and writes to its file 4.
        let script = "exec \"$@\" 3<&0 4>&1 </dev/null >/dev/null 2>&1";
        let mut child = Command::new("sh")
            .args(["-c", script, "sh", &named, "--headless=new", "--no-sandbox"])
            .args(["--remote-debugging-pipe", "--no-first-run"])
            .args(options)
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a shell");
        let to = child.stdin.take().expect("its input");
        let output = child.stdout.take().expect("its output");
        let (send, from) = channel();
        thread::spawn(move || {
            for message in BufReader::new(output).split(0).map_while(Result::ok) {
                let Ok(message) = serde_json::from_slice(&message) else { break };
                if send.send(message).is_err() {
                    break;
                }
            }
        });
        let (session, events) = (None, Vec::new());
        let mut browser = Self { child, to, from, last: 0, session, events, _profile: profile };
        let target = browser.call("Target.createTarget", json!({"url": "about:blank"}));
        let attached = browser.call(
            "Target.attachToTarget",
            json!({"targetId": target["targetId"], "flatten": true}),
        );
        browser.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser.events.clear();
        Some(browser)
    }

    /// Opens a file with a fragment after `#`, and waits until it is loaded.
    pub fn open(&mut self, file: &Path, part: &str) {
        let url = format!("file://{}#{part}", file.display());
        // A blank page first, because changing only the fragment would not load the page again.
        for url in ["about:blank", &url] {
            self.events.clear();
            self.call("Page.navigate", json!({"url": url}));
            self.until("Page.loadEventFired");
        }
    }

    /// Returns the value of an expression on the page.
    pub fn value(&mut self, expression: &str) -> Json {
        let asked = json!({
            "expression": expression, "returnByValue": true, "awaitPromise": true,
        });
        let answer = self.call("Runtime.evaluate", asked);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Returns the text of the element that a selector finds.
    pub fn text(&mut self, selector: &str) -> String {
        let text = self.value(&format!("document.querySelector({}).textContent", json!(selector)));
        text.as_str().unwrap_or_else(|| panic!("{selector}: {text}")).to_owned()
    }

    /// Presses and releases a key.
    pub fn press(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            let mut event = json!({"type": kind, "key": key});
            if key.chars().count() == 1 && kind == "keyDown" {
                event["text"] = json!(key);
            }
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Clicks into the middle of the element that a selector finds.
    pub fn click(&mut self, selector: &str) {
        let found = self.value(&format!(
            "(() => {{ const e = document.querySelector({}); e.scrollIntoView({{block: 'center'}}); \
             const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()",
            json!(selector)
        ));
        for kind in ["mousePressed", "mouseReleased"] {
            self.call(
                "Input.dispatchMouseEvent",
                json!({
                    "type": kind, "x": found[0], "y": found[1], "button": "left", "clickCount": 1,
                }),
            );
        }
    }

    /// Drags from the middle of the element that a selector finds, by pixels right and down.
    pub fn drag(&mut self, selector: &str, [right, down]: [f64; 2]) {
        let found = self.value(&format!(
            "(() => {{ const b = document.querySelector({}).getBoundingClientRect(); \
             return [b.x + b.width / 2, b.y + b.height / 2]; }})()",
            json!(selector)
        ));
        let [x, y] = [0, 1].map(|k| found[k].as_f64().expect("a place"));
        let places = [("mousePressed", x, y), ("mouseMoved", x + right, y + down)];
        let places = places.into_iter().chain([("mouseReleased", x + right, y + down)]);
        for (kind, x, y) in places {
            let event = json!({
                "type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1,
            });
            self.call("Input.dispatchMouseEvent", event);
        }
    }

    /// Returns the addresses requested since the page was opened.
    pub fn requests(&self) -> Vec<&str> {
        let of = |event: &&Json| event["method"] == "Network.requestWillBeSent";
        let sent = self.events.iter().filter(of);
        sent.filter_map(|event| event["params"]["request"]["url"].as_str()).collect()
    }

    /// Returns the console messages since the page was opened, including faults. Messages of the
    /// browser on its graphics are excluded, because they change with its version.
    pub fn complaints(&self) -> Vec<String> {
        let methods = ["Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"];
        let of = |event: &&Json| {
            methods.iter().any(|method| event["method"] == *method)
                && event["params"]["entry"]["source"] != "rendering"
        };
        self.events.iter().filter(of).map(Json::to_string).collect()
    }

    fn call(&mut self, method: &str, parameters: Json) -> Json {
        self.last += 1;
        let mut message = json!({"id": self.last, "method": method, "params": parameters});
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.to.write_all(&bytes).expect("the browser listens");
        loop {
            let answer = self.receive(method);
            if answer["id"] == self.last {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
            self.events.push(answer);
        }
    }

    /// Waits for an event that has not occurred yet, or occurred since the last call.
    fn until(&mut self, method: &str) {
        while !self.events.iter().any(|event| event["method"] == method) {
            let event = self.receive(method);
            self.events.push(event);
        }
    }

    fn receive(&self, doing: &str) -> Json {
        self.from.recv_timeout(PATIENCE).unwrap_or_else(|error| panic!("{doing}: {error}"))
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
