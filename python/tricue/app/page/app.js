// SPDX-License-Identifier: MIT
// The page: its parts, what they do together, and the keys.

import { Model, clock } from "./model.js";
import { commonKeys, leaveKeys, listenToKeys } from "./keys.js";
import { command, listen, Pictures } from "./link.js";
import { Panel } from "./panel.js";
import { Stage } from "./stage.js";
import { LOST, NONE, STATUS_NAMES } from "./targets.js";
import { Timeline } from "./timeline.js";
import { complain, note } from "./toasts.js";

const get = (id) => document.getElementById(id);
const model = new Model();
const stage = new Stage(get("picture"), model, {
  drawn: draw,
  clicked: (id) => model.choose(id),
  held: hold,
  refused: () => note("Press Pause to draw a box"),
});
const pictures = new Pictures((image) => image === stage.image);
new Timeline(get("timeline"), model, go);
const panel = new Panel(model, { act, went: go });
let loading = false; // a picture is being fetched
let playing = null; // {begin, began}: the time in the video, and the clock's, since when it plays
let wanted = null; // where to go once it is paused
let finished = false; // whether the boxes that were asked for are drawn

// Commands

async function act(name, values = {}) {
  try {
    const answer = await command(name, values);
    if (name === "add") {
      await known(answer.id);
      model.choose(answer.id);
    }
    return answer;
  } catch (error) {
    complain(error.message);
    return null;
  }
}

/** Wait until the server has told of a target. */
function known(id) {
  return new Promise((resolve) => {
    const look = () => {
      if (!model.target(id)) return;
      model.removeEventListener("state", look);
      resolve();
    };
    model.addEventListener("state", look);
    look();
  });
}

/** The picture stays while someone draws in it; null for no longer. */
function hold(frame) {
  if (frame === null) load();
  else stopPlaying();
}

async function draw(frame, box, target) {
  if (target !== null) await act("draw", { target, frame, box });
  else await act("add", { frame, box, tracker: panel.tracker });
  load();
}

async function track(step) {
  if (model.state.selecting) return;
  stopPlaying();
  const all = get("who").value === "all" || !model.target();
  const { frame } = model;
  const answer = await act("track", { frame, step, ...(all ? {} : { targets: [model.chosen] }) });
  const names = (answer?.left_out ?? []).map((id) => model.target(id)?.name).filter(Boolean);
  if (names.length) note(`Not followed, without a box in frame ${frame}: ${names.join(", ")}`);
}

// Frames

function go(frame) {
  stopPlaying();
  if (model.state.run) {
    wanted = frame;
    return act("pause");
  }
  return model.go(frame);
}

/** Show the picture of the frame that is looked at, and of those looked at meanwhile only the last. */
async function load() {
  if (loading || !model.state) return;
  loading = true;
  while ((stage.shown !== model.frame || stage.coarse) && !model.state.run && !stage.busy) {
    const frame = model.frame;
    const image = await picture(frame);
    if (frame !== model.frame || model.state.run || stage.busy) continue;
    show(frame, image);
  }
  loading = false;
  // A run may end with the picture that was shown before it.
  if (stage.shown === model.frame && !model.state.run && !stage.busy) say(`shown ${model.frame}`);
}

/** A frame's picture; null, and a complaint, if it can't be shown. */
async function picture(frame) {
  try {
    return await pictures.get(frame);
  } catch (error) {
    complain(error.message);
    return null;
  }
}

function show(frame, image) {
  stage.show(frame, image);
  updateHint();
  say(`shown ${frame}`);
}

/** Fetch a picture again that couldn't be had, perhaps because the connection was down. */
function retry() {
  stage.show(model.frame, null, true);
  load();
}

function say(text) {
  document.documentElement.dataset.page = text; // for tests
}

async function play() {
  if (model.frame === model.state.frames - 1) model.go(0);
  const mine = (playing = { begin: model.seconds(model.frame), began: performance.now() });
  updateControls();
  while (playing === mine) {
    const due = model.frameAt(mine.begin + (performance.now() - mine.began) / 1000);
    const next = Math.min(Math.max(due, model.frame + 1), model.state.frames - 1);
    const image = await picture(next);
    const wait = (model.seconds(next) - mine.begin) * 1000 - (performance.now() - mine.began);
    if (next + 1 < model.state.frames) pictures.get(next + 1).catch(() => {});
    if (wait > 0) await new Promise((resolve) => setTimeout(resolve, wait));
    if (playing !== mine) return;
    model.go(next);
    show(next, image);
    if (next === model.state.frames - 1) break;
  }
  if (playing === mine) stopPlaying();
}

function stopPlaying() {
  if (!playing) return;
  playing = null;
  updateControls();
}

function playOrPause() {
  if (model.state.run) return act("pause");
  return playing ? stopPlaying() : play();
}

function nextTrouble() {
  const target = model.target();
  const ids = target ? [target.id] : model.state.targets.map((each) => each.id);
  const starts = ids.flatMap((id) => model.troubles(id).map(([first]) => first)).sort((a, b) => a - b);
  if (!starts.length) return note(target ? `${target.name} is nowhere lost or occluded` : "No target is lost or occluded");
  return go(starts.find((at) => at > model.frame) ?? starts[0]);
}

function nextDrawn() {
  const chosen = model.target() ? [model.target()] : model.state.targets;
  const frames = chosen.flatMap((each) => each.drawn).sort((a, b) => a - b);
  if (!frames.length) return note("No box is drawn");
  return go(frames.find((at) => at > model.frame) ?? frames[0]);
}

// What the server tells

listen({
  hear(message) {
    if (message.type === "state") hearState(message);
    else if (message.type === "times") model.times = message.times;
    else if (message.type === "tracks") model.setTracks(message.target, message.tracks, true);
    else if (message.type === "run") hearRun(message);
    else if (message.type === "error") complain(message.error);
  },
  async show(frame, blob) {
    const image = await createImageBitmap(blob);
    if (!model.state?.run) return;
    if (!stage.busy) stage.show(frame, image, true);
    model.go(frame);
  },
  status(there) {
    if (!there) stopPlaying();
    else if (stage.shown === model.frame && !stage.image) retry();
    get("gone").hidden = there || finished;
    get("gone-file").textContent = model.state ? workText(model.state) : "";
  },
});

function hearState(state) {
  document.documentElement.dataset.version = state.version; // for tests
  const first = !model.state, runs = model.state?.ended?.run;
  const tracker = model.state?.tracker;
  if (tracker) state.tracker = tracker;
  model.setState(state);
  if (first && state.targets.length) model.choose(state.targets[0].id);
  if (!first && !state.run && state.ended?.run !== runs) runEnded(state.ended);
}

function hearRun({ frame, speed, tracks }) {
  for (const [id, rows] of Object.entries(tracks)) model.setTracks(Number(id), rows, false);
  get("speed").textContent = speed ? `${Math.round(speed).toLocaleString("en")} updates/s` : "";
  say(`tracking ${frame}`);
}

function runEnded({ frame, step, targets, stopped }) {
  get("speed").textContent = "";
  noteStops(targets, stopped);
  if (Object.values(stopped).includes(frame + step)) wanted ??= frame + step; // from where tracking can go on
  const lost = targets.filter((id) => model.status(id, frame) === LOST).map((id) => model.target(id)?.name);
  announce(`Tracking ended at frame ${frame}${lost.length ? `; lost: ${lost.join(", ")}` : ""}`);
  model.go(wanted ?? frame);
  wanted = null;
  load();
}

/** Say which of the followed targets stopped at a drawn box; others may have gone on. */
function noteStops(followed, stopped) {
  const names = new Map(); // by frame
  for (const [id, at] of Object.entries(stopped)) {
    const target = model.target(Number(id));
    if (target) names.set(at, [...(names.get(at) ?? []), target.name]);
  }
  const list = new Intl.ListFormat("en");
  for (const [at, those] of names) {
    const who = those.length === followed.length ? "Tracking" : list.format(those);
    note(`${who} stopped at the box drawn in frame ${at}`);
  }
}

function announce(text) {
  get("said").textContent = text;
}

// The page's parts

function updateControls() {
  const { state } = model;
  const run = Boolean(state.run);
  get("name").textContent = state.name;
  document.title = `${state.name} - tricue`;
  get("saved").textContent = savedText(state);
  get("saved").title = state.unsaved || (state.file ?? "");
  get("undo").disabled = !state.undo;
  get("redo").disabled = !state.redo;
  get("export").disabled = !state.targets.length;
  get("export").hidden = state.selecting;
  const moves = hasKeyFocus(run ? ["track", "track-back"] : ["pause"]);
  get("pause").hidden = !run;
  for (const id of ["track", "track-back"]) {
    get(id).hidden = run || state.selecting;
    get(id).disabled = !state.targets.length;
  }
  if (moves) get(run ? "pause" : "track").focus();
  get("who").parentElement.hidden = state.targets.length < 2 || state.selecting;
  const active = playing || run;
  get("play").setAttribute("aria-label", active ? "Pause" : "Play");
  get("play").querySelector("use").setAttribute("href", active ? "#i-pause" : "#i-play");
  get("frame").max = state.frames - 1;
  get("changed").hidden = !state.changed_video.length;
  get("changed-how").textContent = state.changed_video.join(", ");
  get("help-file").textContent = workText(state);
  document.documentElement.style.setProperty("--aspect", state.size[0] / state.size[1]);
  updateHint();
  updateVideo(state.video);
}

/** Whether one of these buttons has the focus that keys move. */
function hasKeyFocus(ids) {
  const { activeElement } = document;
  return ids.includes(activeElement?.id) && activeElement.matches(":focus-visible");
}

function workText(state) {
  if (state.file && state.unsaved) return `The last changes are not saved: ${state.unsaved}.`;
  return state.file ? `Your work is kept in ${state.file}.` : "";
}

function savedText(state) {
  if (!state.file) return "";
  if (state.unsaved) return `not saved: ${state.unsaved}`;
  if (state.changed_video.length) return "not saved";
  const where = state.beside ? "" : ` in ${state.file}`;
  return state.saved && !state.run ? `saved${where}` : `saving${where}`;
}

function updateHint() {
  const { state } = model;
  const target = model.target();
  let text = "";
  if (state.run) text = "";
  else if (stage.shown === model.frame && !stage.image) text = `Frame ${model.frame} can't be shown`;
  else if (!state.targets.length) text = "Drag a box around the target";
  else if (!target) text = "Drag a box around the next target, or choose one";
  else if (!state.selecting && target.untracked.includes(model.frame)) text = untrackedHint(target);
  else if (model.status(target.id, model.frame) === LOST) text = `${target.name} is lost here: drag a box to correct it`;
  get("hint").textContent = text;
}

/** What to do about a box from which nothing was tracked yet. */
function untrackedHint(target) {
  if (target.drawn.length === 1 && onlyDrawn(target)) return "Press Track, or drag the box to make it fit better";
  const { frame } = model, free = (at) => at >= 0 && at < model.state.frames && !target.drawn.includes(at);
  const ways = [free(frame + 1) && "Track", free(frame - 1) && "Back"].filter(Boolean);
  return ways.length ? `Press ${ways.join(" or ")} to track from this box` : "";
}

function onlyDrawn(target) {
  const status = model.tracks.get(target.id)?.status;
  return !status || status.reduce((count, each) => count + (each !== NONE), 0) <= 1;
}

function updateVideo(video) {
  const bar = get("video-progress");
  const writing = Boolean(video) && !video.done && !video.error;
  bar.hidden = !writing;
  get("video").textContent = writing ? "Cancel" : "Video";
  get("video-file").hidden = !video?.done;
  bar.value = video ? video.written / video.total : 0;
  get("video-state").textContent = videoText(video, bar.value);
  if (video?.done && get("video").dataset.asked) {
    delete get("video").dataset.asked;
    get("video-file").click();
  }
}

function videoText(video, share) {
  if (!video) return "with the boxes drawn in it; plays in any browser";
  return video.error || (video.done ? "written" : `writing, ${Math.floor(100 * share)} %`);
}

function updateFrame() {
  if (document.activeElement !== get("frame")) get("frame").value = model.frame;
  get("time").textContent = clock(model.seconds(model.frame));
  updateHint();
  if (!playing) load();
}

model.addEventListener("state", () => {
  updateControls();
  updateFrame();
});
model.addEventListener("frame", updateFrame);
model.addEventListener("tracks", updateHint);
model.addEventListener("choice", () => {
  updateHint();
  const target = model.target();
  if (target) announce(`${target.name} chosen, ${STATUS_NAMES[model.status(target.id, model.frame)] || "no box here"}`);
});

const CLICKS = {
  undo: () => act("undo"),
  redo: () => act("redo"),
  first: () => go(0),
  last: () => go(model.state.frames - 1),
  back: () => go(model.frame - 1),
  next: () => go(model.frame + 1),
  play: playOrPause,
  pause: () => act("pause"),
  track: () => track(1),
  "track-back": () => track(-1),
  new: () => model.choose(null),
  export: () => get("export-dialog").showModal(),
  help: () => get("help-dialog").showModal(),
  "changed-keep": () => act("keep", { keep: true }),
  "changed-anew": () => act("keep", { keep: false }),
  video() {
    if (!get("video-progress").hidden) return act("cancel-video");
    get("video").dataset.asked = "yes";
    return act("video", { trail: stage.trail });
  },
  async done() {
    if (!(await act("select"))) return;
    finished = get("gone").hidden = true;
    get("selecting").firstElementChild.textContent = "Done. This page can be closed.";
    get("done").hidden = true;
  },
};
for (const [id, click] of Object.entries(CLICKS)) get(id).addEventListener("click", click);
for (const button of document.querySelectorAll("[data-close]")) {
  button.addEventListener("click", () => button.closest("dialog").close());
}
get("trail").addEventListener("change", (event) => {
  stage.trail = event.target.checked;
  stage.draw();
});
get("frame").addEventListener("change", (event) => {
  const frame = event.target.valueAsNumber;
  if (!Number.isNaN(frame)) go(frame);
  event.target.value = model.frame; // which isn't what was written if there is no such frame
});
get("frame").addEventListener("keydown", (event) => event.key === "Enter" && event.target.blur());
leaveKeys(get("who"));
leaveKeys(get("trail"));

// Keys

const KEYS = {
  ...commonKeys(model, stage),
  ArrowLeft: (event) => go(model.frame - (event.shiftKey ? 10 : 1)),
  ArrowRight: (event) => go(model.frame + (event.shiftKey ? 10 : 1)),
  Home: () => go(0),
  End: () => go(model.state.frames - 1),
  " ": playOrPause,
  t: () => track(1),
  b: () => track(-1),
  n: () => model.choose(null),
  l: nextTrouble,
  d: nextDrawn,
  Delete: () => model.target() && act("delete", { target: model.chosen }),
  "?": () => get("help-dialog").showModal(),
};

listenToKeys(model, KEYS, (event) => {
  const undo = { z: event.shiftKey ? "redo" : "undo", y: "redo" }[event.key.toLowerCase()];
  if (undo) act(undo);
  return undo;
});
