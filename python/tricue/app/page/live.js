// SPDX-License-Identifier: MIT
// The page of a camera: the newest picture, the targets in it, drawing, recording, and the keys.

import { LiveModel } from "./live_model.js";
import { commonKeys, leaveKeys, listenToKeys } from "./keys.js";
import { command, listen } from "./link.js";
import { clock } from "./model.js";
import { Stage } from "./stage.js";
import { listTargets } from "./target_list.js";
import { LOST, NONE, STATUS_NAMES } from "./targets.js";
import { complain } from "./toasts.js";

const get = (id) => document.getElementById(id);
const model = new LiveModel();
const stage = new Stage(get("picture"), model, { drawn: draw, clicked: (id) => model.choose(id), held: hold });
let send = () => {}; // a message to the server
let chosenTracker = null; // of the next target
let focused = false; // whether someone writes the numbers of a box

// Commands

async function act(name, values = {}) {
  try {
    return await command(name, values);
  } catch (error) {
    complain(error.message);
    return null;
  }
}

/** Keep a frame at the server, and its picture here, while someone draws in it; null for no longer. */
function hold(frame) {
  send({ hold: frame });
}

/** Draw a box of a target, null for a new one; the frame is kept until the server has it. */
async function draw(frame, box, target) {
  if (target !== null) await act("draw", { target, frame, box });
  else {
    const answer = await act("add", { frame, box, tracker: tracker() });
    if (answer) chooseLater(answer.id);
  }
  hold(null);
}

/** Choose a target as soon as the server has told of it. */
function chooseLater(id) {
  const look = () => {
    if (!model.target(id)) return;
    model.removeEventListener("state", look);
    model.choose(id);
  };
  model.addEventListener("state", look);
  look();
}

function tracker() {
  return chosenTracker ?? model.state.tracker;
}

function remove() {
  if (model.target()) act("delete", { target: model.chosen });
}

async function setBox() {
  const box = ["x", "y", "w", "h"].map((name) => get(`box-${name}`).valueAsNumber);
  if (box.some(Number.isNaN)) return complain("box: expected four numbers");
  await draw(stage.shown, box, model.chosen);
  if (get("box").contains(document.activeElement)) document.activeElement.blur();
}

// What the server tells

listen({
  hear(message) {
    if (message.type === "state") model.setState(message);
    else if (message.type === "tracks") model.addFrames(message.frames);
    else if (message.type === "health") hearHealth(message);
    else if (message.type === "error") complain(message.error);
  },
  async show(frame, blob) {
    const image = await createImageBitmap(blob);
    if (stage.busy || focused) return;
    stage.show(frame, image, true);
    updateNow();
    document.documentElement.dataset.page = `shown ${frame}`; // for tests
  },
  status(there) {
    get("gone").hidden = there;
  },
  tell(sending) {
    send = sending;
  },
});

function hearHealth({ dropped, reopened, trouble, rate, recorded }) {
  const words = rate ? [`${rate.toFixed(rate < 10 ? 1 : 0)} frames/s`] : [];
  if (model.frame >= 0) words.push(`${dropped.toLocaleString("en")} dropped`);
  if (reopened) words.push(`reconnected ${reopened === 1 ? "once" : `${reopened} times`}`);
  get("rate").textContent = words.join(", ");
  get("trouble").hidden = !trouble;
  get("trouble-what").textContent = trouble ? `${model.state?.name ?? ""}: ${trouble}` : "";
  get("recorded-for").textContent = recorded === null ? "" : clock(recorded, 0);
}

// The page's parts

function update() {
  const { state } = model;
  const ready = ["live", "paused"].includes(state.phase), paused = state.phase === "paused";
  get("name").textContent = state.name;
  document.title = `${state.name} - tricue`;
  document.documentElement.dataset.phase = state.phase; // for tests
  document.documentElement.style.setProperty("--aspect", state.size[1] ? state.size[0] / state.size[1] : 1.778);
  get("problem").hidden = state.phase !== "ended";
  get("problem-what").textContent = state.problem;
  get("pause").disabled = get("record").disabled = !ready;
  label("pause", paused ? "Resume" : "Pause", paused ? "#i-play" : "#i-pause");
  label("record", state.recording ? "Stop" : "Record", state.recording ? "#i-stop" : "#i-record");
  get("recorded").hidden = state.recording || !state.recorded.length;
  get("recorded-where").textContent = `recorded in ${state.folder}: `;
  for (const kind of ["csv", "json", "mp4"]) get(`recorded-${kind}`).hidden = !state.recorded.some((name) => name.endsWith(`.${kind}`));
  get("help-folder").textContent = `Recordings are written to ${state.folder}.`;
  updateTargets();
}

function label(id, text, icon) {
  get(id).querySelector("span").textContent = text;
  get(id).querySelector("use").setAttribute("href", icon);
}

function updateTargets() {
  const { state } = model;
  listTargets(get("targets"), model);
  const target = model.target();
  get("target-name").closest("div").hidden = !target;
  if (document.activeElement !== get("target-name")) get("target-name").value = target?.name ?? "";
  const names = Object.keys(state.trackers);
  if (get("target-tracker").options.length !== names.length) {
    get("target-tracker").replaceChildren(...names.map((name) => new Option(name, name)));
  }
  get("target-tracker").value = target?.tracker ?? tracker();
  get("tracker-about").textContent = state.trackers[get("target-tracker").value] ?? "";
  updateNow();
}

/** What changes with each frame: status and score of each target, the hint, the numbers of the box. */
function updateNow() {
  const at = stage.shown;
  for (const button of get("targets").querySelectorAll("button")) {
    const id = Number(button.dataset.target), status = model.status(id, at);
    const now = button.querySelector("span");
    now.className = STATUS_NAMES[status];
    const place = model.place(id, at);
    now.textContent = [STATUS_NAMES[status], status === NONE ? "" : model.score(id, at).toFixed(2), place].filter(Boolean).join("  ");
  }
  const target = model.target(), { state } = model;
  let hint = "";
  if (state.phase === "connecting") hint = `Waiting for ${state.name}`;
  else if (state.phase === "ended") hint = "";
  else if (state.phase === "paused" && state.recording) hint = "Nothing is recorded while paused";
  else if (target?.stopped) hint = `${target.name}'s tracker has stopped: drag a box to start it again`;
  else if (target && model.status(target.id, at) === LOST) hint = `${target.name} is lost: drag a box to correct it`;
  else if (!state.targets.length) hint = "Drag a box around the target";
  else if (!target) hint = "Drag a box around the next target, or choose one";
  get("hint").textContent = hint;
  if (!focused) {
    const box = target && model.box(target.id, at);
    ["x", "y", "w", "h"].forEach((name, index) => {
      get(`box-${name}`).value = box ? Math.round(box[index] * 10) / 10 : "";
    });
  }
}

model.addEventListener("state", update);
model.addEventListener("choice", () => {
  updateTargets();
  const target = model.target();
  if (!target) return;
  // A new target has no status before its first tracks come.
  const words = [`${target.name} chosen`, STATUS_NAMES[model.status(target.id, stage.shown)]];
  get("said").textContent = words.filter(Boolean).join(", ");
});

const CLICKS = {
  new: () => model.choose(null),
  delete: remove,
  pause: () => act(model.state.phase === "paused" ? "go-on" : "pause"),
  record: () => act(model.state.recording ? "stop-recording" : "record"),
  again: () => act("again"),
  help: () => get("help-dialog").showModal(),
  "box-set": setBox,
};
for (const [id, click] of Object.entries(CLICKS)) get(id).addEventListener("click", click);
for (const button of document.querySelectorAll("[data-close]")) {
  button.addEventListener("click", () => button.closest("dialog").close());
}
get("trail").addEventListener("change", (event) => {
  stage.trail = event.target.checked;
  stage.draw();
});
get("target-name").addEventListener("change", async (event) => {
  if (!model.target()) return;
  if (!(await act("rename", { target: model.chosen, name: event.target.value }))) updateTargets(); // to the name that it has
});
get("target-name").addEventListener("keydown", (event) => event.key === "Enter" && event.target.blur());
get("target-tracker").addEventListener("change", async (event) => {
  chosenTracker = event.target.value;
  const done = model.target() && (await act("tracker", { target: model.chosen, tracker: chosenTracker }));
  if (!done) updateTargets(); // to the one that it has
});
leaveKeys(get("target-tracker"));
leaveKeys(get("trail"));
get("box").addEventListener("keydown", (event) => event.key === "Enter" && event.target.type === "number" && setBox());
// Numbers belong to a picture, which stays while they are written.
get("box").addEventListener("focusin", (event) => {
  if (event.target.type !== "number" || focused) return;
  focused = true;
  hold(stage.shown);
});
get("box").addEventListener("focusout", (event) => {
  if (get("box").contains(event.relatedTarget)) return;
  focused = false;
  hold(null);
});

// Keys

const KEYS = {
  ...commonKeys(model, stage),
  " ": CLICKS.pause,
  r: CLICKS.record,
  n: CLICKS.new,
  Delete: remove,
  "?": CLICKS.help,
};

listenToKeys(model, KEYS);
