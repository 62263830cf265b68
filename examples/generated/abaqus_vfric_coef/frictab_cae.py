# -*- coding: utf-8 -*-
"""Makes the interaction properties of frictab's routine in Abaqus/CAE and assigns them.

Run it by File > Run Script, or: abaqus cae noGUI=frictab_cae.py. The numbers are those of
frictab.inp: replace them by those of your process. The routine itself is chosen in the job:
General > User subroutine file.

TangentialBehavior, contactPropertyAssignments and keywordBlock are used as in public scripts;
recalled: setValues(interactionProperty=...) of a contact pair. CAE writes *Friction, user, which
is FRIC or VFRIC: for the other routines this script edits the keywords, at the end, since later
changes of the model may conflict with edited keywords.
"""
from abaqus import mdb
from abaqusConstants import GLOBAL, ON, SELF, USER_DEFINED

MODEL = 'Model-1'
# Interactions that get each property. None: all of the model.
INTERACTIONS = {
    'FRICTAB': None,
}
# Name, number of state variables, properties, lines of the input deck.
LAWS = [
    ('FRICTAB', 0, (110, 480,), """
*Surface Interaction, name=FRICTAB
*Friction, user=coefficient, properties=2
 110, 480
"""),
]


def make(model, name, states, values):
    about = {'formulation': USER_DEFINED, 'nStateDependentVars': states}
    if values:
        about.update(useProperties=ON, table=tuple((float(value),) for value in values))
    model.ContactProperty(name)
    model.interactionProperties[name].TangentialBehavior(**about)


def assign(model, name):
    chosen = INTERACTIONS[name]
    for key, interaction in model.interactions.items():
        if chosen is not None and key not in chosen:
            continue
        if hasattr(interaction, 'contactPropertyAssignments'):
            interaction.contactPropertyAssignments.appendInStep(
                stepName='Initial', assignments=((GLOBAL, SELF, name),))
        elif hasattr(interaction, 'interactionProperty'):
            interaction.setValues(interactionProperty=name)
        else:
            print('%s is not a contact and stays as it is' % key)
            continue
        print('%s has the property %s' % (key, name))


def write_keywords(model, name, lines):
    model.keywordBlock.synchVersions(storeNodesAndElements=False)
    mine = False
    for at, block in enumerate(model.keywordBlock.sieBlocks):
        text = block.lower()
        if text.startswith('*surface interaction'):
            head = text.split('\n')[0].split('name=')[-1]
            mine = head.split(',')[0].strip(' "') == name.lower()
        elif mine and text.startswith('*friction'):
            model.keywordBlock.replace(at, '\n' + lines[lines.index('*Friction'):].strip())
            return
    raise RuntimeError('no *Friction of ' + name + ' among the keywords of the model')


the_model = mdb.models[MODEL]
for law in LAWS:
    make(the_model, law[0], law[1], law[2])
    assign(the_model, law[0])
for law in LAWS:
    if ', user=' in law[3]:
        write_keywords(the_model, law[0], law[3])
