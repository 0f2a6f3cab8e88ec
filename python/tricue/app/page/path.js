// SPDX-License-Identifier: MIT
// The path from above: x to the right, distance upwards, meters, at one scale; the camera is at the bottom.

import { LOST } from "./targets.js";

const MARGIN = 20; // pixels
const STEPS = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];

/** Whether any target has a position. */
export function hasPath(model) {
  return [...model.tracks.values()].some((tracks) => tracks.placed);
}

export function drawPath(canvas, model, frame) {
  const ratio = devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (!width) return;
  Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  const ink = getComputedStyle(canvas);
  const paths = model.state.targets.map((target) => ({ target, points: points(model.tracks.get(target.id)) }));
  const all = paths.flatMap(({ points }) => points);
  if (!all.length) return;
  const reach = 1.08 * all.reduce((most, [, , z]) => Math.max(most, z), 0.1);
  const side = 1.1 * all.reduce((most, [, x]) => Math.max(most, Math.abs(x)), 0.05);
  const scale = Math.min((height - 2 * MARGIN) / reach, (width / 2 - 4) / side);
  const place = (x, z) => [width / 2 + x * scale, height - MARGIN - z * scale];
  grid(pen, ink, place, scale, reach, width);
  for (const { target, points } of paths) {
    pen.fillStyle = model.color(target.id);
    for (const [, x, z, status] of points) {
      pen.globalAlpha = status === LOST ? 0.15 : 0.55;
      pen.fillRect(...place(x, z).map((value) => value - 1), 2, 2);
    }
    pen.globalAlpha = 1;
    const now = model.tracks.get(target.id)?.place(frame);
    if (now) {
      pen.beginPath();
      pen.arc(...place(now[0], now[2]), 5, 0, 2 * Math.PI);
      pen.fill();
      pen.strokeStyle = ink.getPropertyValue("--ink");
      pen.lineWidth = 1.5;
      pen.stroke();
    }
  }
}

/** Frame, x, z and status of each position. */
function points(tracks) {
  const found = [];
  for (let at = 0; tracks && at < tracks.status.length; at++) {
    const place = tracks.place(at);
    if (place) found.push([at, place[0], place[2], tracks.status[at]]);
  }
  return found;
}

function grid(pen, ink, place, scale, reach, width) {
  const step = STEPS.find((each) => each * scale > 34) ?? 200;
  pen.strokeStyle = ink.getPropertyValue("--line");
  pen.fillStyle = ink.getPropertyValue("--soft");
  pen.font = "11px system-ui, sans-serif";
  pen.lineWidth = 1;
  for (let z = step; z <= reach; z += step) {
    const [, y] = place(0, z);
    pen.beginPath();
    pen.moveTo(0, Math.round(y) + 0.5);
    pen.lineTo(width, Math.round(y) + 0.5);
    pen.stroke();
    pen.fillText(`${Number(z.toFixed(2))}`, 4, y - 3);
  }
  const [x, y] = place(0, 0);
  pen.fillStyle = ink.getPropertyValue("--ink");
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x - 7, y + 11);
  pen.lineTo(x + 7, y + 11);
  pen.fill();
}
