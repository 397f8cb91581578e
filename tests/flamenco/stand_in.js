// SPDX-License-Identifier: GPL-3.0-or-later
// Flamenco Manager as far as its documentation promises it to job types, and no more.
//
//     node stand_in.js JOB_TYPE.js SETTINGS.json     prints the job type and the compiled tasks as JSON
//
// What is not documented is an error: other settings, other names of globals, unknown parameters of commands.

const fs = require("fs");
const vm = require("vm");

const SETTING_KEYS = {
  key: "string", type: "string", subtype: "string", choices: "object", propargs: "object",
  description: "string", default: null, eval: "string", evalInfo: "object", visible: "string",
  required: "boolean", editable: "boolean", label: "string",
};
const TYPES = { string: "string", int32: "number", float: "number", bool: "boolean" };
const SUBTYPES = ["file_path", "dir_path", "file_name", "hashed_file_path"];
const VISIBLE = ["visible", "hidden", "submission", "web"];
const PARAMETERS = {
  "blender-render": { exe: "string", exeArgs: "string", argsBefore: "array", blendfile: "string", args: "array" },
};

function demand(condition, text) {
  if (!condition) throw new Error(text);
}

class Command {
  constructor(name, parameters) {
    const known = PARAMETERS[name];
    demand(known, `no command ${name}`);
    demand(Object.keys(parameters).sort().join() === Object.keys(known).sort().join(), "parameters");
    for (const [key, kind] of Object.entries(known)) {
      const value = parameters[key];
      demand(kind === "array" ? Array.isArray(value) : typeof value === kind, `type of ${key}`);
      if (kind === "array") value.forEach((word) => demand(typeof word === "string", `word of ${key}`));
    }
    Object.assign(this, { name, parameters });
  }
}

class Task {
  constructor(name, type) {
    demand(typeof name === "string" && typeof type === "string", "a task has a name and a type");
    Object.assign(this, { name, type, commands: [], dependencies: [] });
  }
  addCommand(command) {
    demand(command instanceof Command, "author.Command makes commands");
    this.commands.push(command);
  }
  addDependency(task) {
    demand(task instanceof Task, "author.Task makes tasks");
    this.dependencies.push(task.name);
  }
}

function explode(range) {
  const frames = new Set();
  for (const part of range.replaceAll("..", "-").split(",")) {
    const ends = part.split("-").map((word) => word.trim());
    demand(ends.length <= 2 && ends.every((word) => /^\d+$/.test(word)), `invalid range "${range}"`);
    for (let frame = +ends[0]; frame <= +ends[ends.length - 1]; frame++) frames.add(frame);
  }
  demand(frames.size, `empty range "${range}"`);
  return [...frames].sort((a, b) => a - b);
}

// Two frames in a row are "1,2", more are "1-3".
function merge(frames) {
  const words = [];
  for (let i = 0; i < frames.length; ) {
    let last = i;
    while (frames[last + 1] === frames[last] + 1) last++;
    if (last - i >= 2) words.push(`${frames[i]}-${frames[last]}`);
    else words.push(...frames.slice(i, last + 1));
    i = last + 1;
  }
  return words.join(",");
}

function frameChunker(range, size) {
  demand(Number.isInteger(size) && size > 0, `invalid chunk size: ${size}`);
  const frames = explode(range);
  const chunks = [];
  for (let i = 0; i < frames.length; i += size) chunks.push(merge(frames.slice(i, i + size)));
  return chunks;
}

function checkJobType(jobType) {
  demand(typeof jobType.label === "string", "a job type has a label");
  for (const setting of jobType.settings) {
    for (const [key, value] of Object.entries(setting)) {
      demand(key in SETTING_KEYS, `setting ${setting.key}: unknown ${key}`);
      demand(!SETTING_KEYS[key] || typeof value === SETTING_KEYS[key], `setting ${setting.key}: ${key}`);
    }
    demand(/^[a-z_]+$/.test(setting.key) && setting.type in TYPES, `setting ${setting.key}: type`);
    demand(!setting.subtype || SUBTYPES.includes(setting.subtype), `setting ${setting.key}: subtype`);
    demand(!setting.visible || VISIBLE.includes(setting.visible), `setting ${setting.key}: visible`);
    demand(!setting.choices || setting.type === "string", `setting ${setting.key}: choices`);
  }
}

// What was submitted, with defaults; required settings have to be there.
function complete(jobType, given) {
  const settings = {};
  for (const { key, type, default: usual, required } of jobType.settings) {
    settings[key] = key in given ? given[key] : usual;
    if (settings[key] === undefined) {
      demand(!required, `setting ${key} is required`);
      delete settings[key];
    } else demand(typeof settings[key] === TYPES[type], `setting ${key} is no ${type}`);
  }
  for (const key of Object.keys(given)) demand(key in settings, `there is no setting ${key}`);
  return settings;
}

const [script, submitted] = process.argv.slice(2);
const globals = {
  author: { Task: (...a) => new Task(...a), Command: (...a) => new Command(...a) },
  frameChunker,
  print: () => {},
  alert: () => {},
};
const context = vm.createContext(globals);
vm.runInContext(fs.readFileSync(script, "utf8") + "\n;globalThis.JOB_TYPE = JOB_TYPE;", context, { filename: script });
checkJobType(globals.JOB_TYPE);
const tasks = [];
const job = {
  name: "test",
  type: "medial-axis-sequence",
  created: new Date(0),
  settings: complete(globals.JOB_TYPE, JSON.parse(fs.readFileSync(submitted, "utf8"))),
  addTask(task) {
    demand(task instanceof Task && task.commands.length, "a task with commands is added");
    tasks.push(task);
  },
};
globals.compileJob(job);
console.log(JSON.stringify({ jobType: globals.JOB_TYPE, tasks }));
