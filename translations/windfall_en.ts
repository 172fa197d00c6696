<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>JobsIndicator</name>
    <message numerus="yes">
        <source>%1 and %n more</source>
        <translation>
            <numerusform>%1 and %n more</numerusform>
            <numerusform>%1 and %n more</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>LeafJobs</name>
    <message numerus="yes">
        <source>Making %n variants of %1</source>
        <translation>
            <numerusform>Making a variant of %1</numerusform>
            <numerusform>Making %n variants of %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Make %n variants</source>
        <translation>
            <numerusform>Make a variant</numerusform>
            <numerusform>Make %n variants</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Separate %n leaves</source>
        <translation>
            <numerusform>Separate %n leaf</numerusform>
            <numerusform>Separate %n leaves</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n leaves stand in the asset list now.</source>
        <translation>
            <numerusform>%n leaf stands in the asset list now.</numerusform>
            <numerusform>%n leaves stand in the asset list now.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>This photo shows %n leaves: Leaf › Separate Several Leaves makes an asset of each.</source>
        <translation>
            <numerusform>This photo shows %n leaf.</numerusform>
            <numerusform>This photo shows %n leaves: Leaf › Separate Several Leaves makes an asset of each.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>PlantShaping</name>
    <message numerus="yes">
        <source>%n</source>
        <translation>
            <numerusform>%n</numerusform>
            <numerusform>%n</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>RulesEditor</name>
    <message numerus="yes">
        <source>%n rule(s)</source>
        <translation>
            <numerusform>%n rule</numerusform>
            <numerusform>%n rules</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>SceneInspector</name>
    <message numerus="yes">
        <source>%1, %n rows</source>
        <translation>
            <numerusform>%1, %n row</numerusform>
            <numerusform>%1, %n rows</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>SceneWorkspace</name>
    <message numerus="yes">
        <source>%1: %n rows of wind</source>
        <translation>
            <numerusform>%1: %n row of wind</numerusform>
            <numerusform>%1: %n rows of wind</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>VariantScores</name>
    <message numerus="yes">
        <source>Scoring %n variants of %1</source>
        <translation>
            <numerusform>Scoring a variant of %1</numerusform>
            <numerusform>Scoring %n variants of %1</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>VariantStrip</name>
    <message numerus="yes">
        <source>Make %n variants</source>
        <translation>
            <numerusform>Make a variant</numerusform>
            <numerusform>Make %n variants</numerusform>
        </translation>
    </message>
</context>
</TS>
