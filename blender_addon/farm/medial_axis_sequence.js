// SPDX-License-Identifier: GPL-3.0-or-later
//
// A job type of Flamenco 3: the medial axis of animated objects, a range of frames in chunks.
// Copy this file into the folder `scripts` beside the Flamenco Manager; the add-on has to be enabled
// in the Blender of every worker (docs/farm.md).

const JOB_TYPE = {
  label: "Medial Axis Sequence",
  description: "Compute the medial axis of an object at every frame, into a file each",
  settings: [
    {
      key: "frames",
      type: "string",
      required: true,
      eval: "f'{C.scene.frame_start}-{C.scene.frame_end}'",
      evalInfo: { showLinkButton: true, description: "Scene frame range" },
      description: "Frames to compute. Examples: '47', '1-30', '3, 5-10, 47-327'",
    },
    {
      key: "chunk_size",
      type: "int32",
      default: 10,
      propargs: { min: 1 },
      visible: "submission",
      description: "Number of frames that one task computes",
    },
    {
      key: "object_name",
      type: "string",
      default: "",
      eval: "C.object.name if C.object else ''",
      evalInfo: { showLinkButton: true, description: "Active object" },
      description: "Whose medial axis; empty: of all visible meshes and point clouds",
    },
    {
      key: "output_folder",
      type: "string",
      subtype: "dir_path",
      required: true,
      description: "Folder for the files NAME_FRAME.FORMAT, which all workers can reach",
    },
    {
      key: "format",
      type: "string",
      choices: ["npz", "ma", "ply", "obj", "off"],
      default: "npz",
      description: "Format of the files; npz is what the add-on plays back",
    },
    {
      key: "options",
      type: "string",
      default: "",
      description: "Options of the command line. Example: '--theta 30 --side both'",
    },
    {
      key: "blendfile",
      type: "string",
      required: true,
      visible: "web",
      description: "Path of the Blend file",
    },
    {
      key: "addon",
      type: "string",
      required: true,
      eval: "next((n for n in C.preferences.addons.keys() if n.split('.')[-1] == 'medial_axis'), '')",
      visible: "web",
      description: "Name under which Blender knows the add-on",
    },
  ],
};

function compileJob(job) {
  const settings = job.settings;
  if (!/^[A-Za-z_][\w.]*$/.test(settings.addon)) {
    throw `the add-on Medial Axis is not enabled where the job was submitted: "${settings.addon}"`;
  }
  for (const chunk of frameChunker(settings.frames, settings.chunk_size)) {
    const task = author.Task(`medial-axis-${chunk}`, "blender");
    task.addCommand(authorCommand(settings, chunk));
    job.addTask(task);
  }
}

// Frames that are finished are kept, so that a task may be run again, or by two workers.
function authorCommand(settings, chunk) {
  const folder = settings.output_folder.replace(/[\/\\]+$/, "") + "/";
  return author.Command("blender-render", {
    exe: "{blender}",
    exeArgs: "{blenderArgs}",
    argsBefore: [],
    blendfile: settings.blendfile,
    args: [
      "--python-exit-code", "1",
      "--python-expr", `from ${settings.addon} import cli; cli.run()`,
      "--", folder,
      `--frames=${chunk}`,
      `--object=${settings.object_name || ""}`,
      `--format=${settings.format}`,
      `--options=${settings.options || ""}`,
      "--json",
    ],
  });
}
