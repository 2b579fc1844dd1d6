// The client of `slowlight lsp`, and the commands that run `slowlight` on the scene in the
// editor.
"use strict";

const { execFile } = require("node:child_process");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;
let pictures;

/** The program, as it is set. */
function program() {
  return vscode.workspace.getConfiguration("slowlight").get("path") || "slowlight";
}

/** What is set for the server. */
function settings() {
  return { target: vscode.workspace.getConfiguration("slowlight").get("target") || "" };
}

async function start() {
  client = new LanguageClient(
    "slowlight",
    "Slowlight",
    { command: program(), args: ["lsp"] },
    {
      documentSelector: [{ language: "slowlight" }],
      initializationOptions: settings(),
      synchronize: {
        configurationSection: "slowlight",
        fileEvents: vscode.workspace.createFileSystemWatcher("**/*.scn"),
      },
    },
  );
  try {
    await client.start();
  } catch (why) {
    const settle = "Open Settings";
    const chosen = await vscode.window.showErrorMessage(
      `Slowlight: \`${program()} lsp\` does not start (${why.message}). ` +
        "Install slowlight, or set slowlight.path to where it is.",
      settle,
    );
    if (chosen === settle) {
      vscode.commands.executeCommand("workbench.action.openSettings", "slowlight.path");
    }
  }
}

async function stop() {
  const running = client;
  client = undefined;
  // One that did not start need not be stopped.
  await running?.stop().catch(() => {});
}

/** Runs the program; what it prints. */
function output(args, cwd) {
  return new Promise((resolve, reject) => {
    execFile(program(), args, { cwd, maxBuffer: 64 << 20 }, (why, stdout, stderr) => {
      if (why) {
        reject(new Error(stderr.trim() || why.message));
      } else {
        resolve(stdout);
      }
    });
  });
}

/** The scene in the editor, saved. */
async function scene() {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== "slowlight") {
    vscode.window.showInformationMessage("Slowlight: open a scene first.");
    return undefined;
  }
  if (document.isUntitled || document.isDirty) {
    await document.save();
  }
  return document.isUntitled ? undefined : document.uri.fsPath;
}

/** One of the machines that there are. */
async function chosenTarget(title, none) {
  const all = JSON.parse(await output(["targets", "--json"]));
  const items = all.map((one) => ({ label: one.target, description: one.about }));
  const before = none ? [{ label: "none", description: none }] : [];
  const chosen = await vscode.window.showQuickPick([...before, ...items], { title });
  return chosen && (chosen.label === "none" ? "" : chosen.label);
}

async function run() {
  const file = await scene();
  const target = file && (await chosenTarget("Run on"));
  if (!target) {
    return;
  }
  const task = new vscode.Task(
    { type: "slowlight", target },
    vscode.TaskScope.Workspace,
    `${path.basename(file)} on ${target}`,
    "slowlight",
    new vscode.ProcessExecution(program(), ["run", path.basename(file), "--target", target], {
      cwd: path.dirname(file),
    }),
  );
  await vscode.tasks.executeTask(task);
}

async function picture() {
  const file = await scene();
  if (!file) {
    return;
  }
  pictures ??= fs.mkdtempSync(path.join(os.tmpdir(), "slowlight-"));
  const png = path.join(pictures, `${path.basename(file, ".scn")}.png`);
  const title = `Drawing ${path.basename(file)}`;
  const location = vscode.ProgressLocation.Notification;
  await vscode.window.withProgress({ location, title }, () =>
    output(["render", file, "-o", png], path.dirname(file)),
  );
  const beside = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
  await vscode.commands.executeCommand("vscode.open", vscode.Uri.file(png), beside);
}

async function measure() {
  const target = await chosenTarget("Show cycles behind lines for", "show none");
  if (target !== undefined) {
    const own = vscode.workspace.getConfiguration("slowlight");
    await own.update("target", target, vscode.workspace.workspaceFolders === undefined);
  }
}

/** A command whose failure is said. */
function command(name, work) {
  return vscode.commands.registerCommand(name, async () => {
    try {
      await work();
    } catch (why) {
      vscode.window.showErrorMessage(`Slowlight: ${why.message}`);
    }
  });
}

exports.activate = async (context) => {
  context.subscriptions.push(
    command("slowlight.run", run),
    command("slowlight.picture", picture),
    command("slowlight.measure", measure),
    command("slowlight.restart", async () => {
      await stop();
      await start();
    }),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("slowlight.path")) {
        await stop();
        await start();
      }
    }),
  );
  await start();
};

exports.deactivate = async () => {
  if (pictures) {
    fs.rmSync(pictures, { recursive: true, force: true });
  }
  await stop();
};
